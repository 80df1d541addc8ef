// An actor that is a sheet of cloth. See docs/manual/unreal.md.

#pragma once

#include "CoreMinimal.h"
#include "GameFramework/Actor.h"
#include "ProceduralMeshComponent.h"

#include "ClothSheet.hpp"

#include "MuslinSheetActor.generated.h"

UCLASS()
class AMuslinSheetActor : public AActor {
  GENERATED_BODY()

 public:
  AMuslinSheetActor();
  void BeginPlay() override;
  void Tick(float Seconds) override;

  /** Particles per row and per column. */
  UPROPERTY(EditAnywhere, Category = "Cloth", meta = (ClampMin = 2))
  int32 Columns = 40;
  UPROPERTY(EditAnywhere, Category = "Cloth", meta = (ClampMin = 2))
  int32 Rows = 40;

  /** Distance between neighbours. */
  UPROPERTY(EditAnywhere, Category = "Cloth", meta = (Units = "cm"))
  float Spacing = 5;

  /** Velocity of the air [cm/s]. */
  UPROPERTY(EditAnywhere, Category = "Cloth")
  FVector Wind = FVector(0, 200, 0);

  /** Actors that push the cloth as spheres. */
  UPROPERTY(EditAnywhere, Category = "Cloth")
  TArray<TObjectPtr<AActor>> Balls;

  /** Radius of these spheres. */
  UPROPERTY(EditAnywhere, Category = "Cloth", meta = (Units = "cm"))
  float BallRadius = 30;

  UPROPERTY(VisibleAnywhere, Category = "Cloth")
  TObjectPtr<UProceduralMeshComponent> Mesh;

 private:
  MuslinVec3 FromStart(const FVector &Position) const;
  void Draw();
  static void Check(MuslinStatus Status);

  /** Where the upper left corner was when play began: positions of the cloth are relative to it. */
  FVector Start = FVector(0, 0, 0);
  ClothSheet Sheet;
  SheetMesh Sides;
  std::vector<MuslinCollider> Colliders;
};
