// Test doubles of the types of Unreal Engine 5 that the actor uses. They keep what they are given, so
// that the test can look at it. They are not checked against the headers of Unreal.

#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

#define UCLASS(...)
#define UPROPERTY(...)
#define GENERATED_BODY()
#define TEXT(text) text

using int32 = std::int32_t;
using uint32 = std::uint32_t;

/// What a failed check prints, in place of a crash report.
inline std::string failed_check;
#define checkf(claim, format, ...) \
  if (!(claim)) failed_check = __VA_ARGS__

struct FVector {
  double X, Y, Z;
  FVector() : X(0), Y(0), Z(0) {}
  FVector(double x, double y, double z) : X(x), Y(y), Z(z) {}
};

struct FVector2D {
  double X, Y;
  FVector2D(double x, double y) : X(x), Y(y) {}
};

struct FQuat {
  double X, Y, Z, W;
  static const FQuat Identity;
};
inline const FQuat FQuat::Identity{0, 0, 0, 1};

struct FLinearColor {};

template <class T>
class TArray : public std::vector<T> {
 public:
  TArray() = default;
  TArray(std::initializer_list<T> items) : std::vector<T>(items) {}
  int32 Add(const T &item) {
    this->push_back(item);
    return Num() - 1;
  }
  int32 Num() const { return static_cast<int32>(this->size()); }
  const T &operator[](int32 at) const { return std::vector<T>::operator[](static_cast<std::size_t>(at)); }
  T &operator[](int32 at) { return std::vector<T>::operator[](static_cast<std::size_t>(at)); }
};

template <class T>
class TObjectPtr {
 public:
  TObjectPtr(T *object = nullptr) : object_(object) {}
  operator T *() const { return object_; }
  T *operator->() const { return object_; }

 private:
  T *object_;
};
