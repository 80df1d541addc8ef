#pragma once

#include "GameFramework/Actor.h"

struct FProcMeshTangent {};

class UProceduralMeshComponent : public USceneComponent {
 public:
  void CreateMeshSection_LinearColor(int32, const TArray<FVector> &to_positions, const TArray<int32> &to_triangles,
                                     const TArray<FVector> &to_normals, const TArray<FVector2D> &,
                                     const TArray<FLinearColor> &, const TArray<FProcMeshTangent> &, bool) {
    positions = to_positions;
    normals = to_normals;
    triangles = to_triangles;
    created++;
  }
  void UpdateMeshSection_LinearColor(int32, const TArray<FVector> &to_positions, const TArray<FVector> &to_normals,
                                     const TArray<FVector2D> &, const TArray<FLinearColor> &,
                                     const TArray<FProcMeshTangent> &) {
    positions = to_positions;
    normals = to_normals;
    updated++;
  }

  TArray<FVector> positions, normals;
  TArray<int32> triangles;
  int created = 0, updated = 0;
};
