#pragma once

#include "CoreMinimal.h"

class USceneComponent {
 public:
  virtual ~USceneComponent() = default;
  void SetUsingAbsoluteLocation(bool is) { is_absolute = is; }
  void SetUsingAbsoluteRotation(bool) {}
  void SetWorldLocationAndRotation(FVector to, const FQuat &) { location = to; }

  bool is_absolute = false;
  FVector location;
};

class AActor {
 public:
  virtual ~AActor() { delete RootComponent; }
  virtual void BeginPlay() {}
  virtual void Tick(float) {}
  FVector GetActorLocation() const { return location; }
  FVector GetActorRightVector() const { return {0, 1, 0}; }
  FVector GetActorUpVector() const { return {0, 0, 1}; }

  FVector location;

 protected:
  template <class T>
  T *CreateDefaultSubobject(const char *) {
    return new T;
  }

  struct {
    bool bCanEverTick = false;
  } PrimaryActorTick;
  USceneComponent *RootComponent = nullptr;
};
