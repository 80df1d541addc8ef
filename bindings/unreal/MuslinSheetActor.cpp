#include "MuslinSheetActor.h"

AMuslinSheetActor::AMuslinSheetActor() {
  PrimaryActorTick.bCanEverTick = true;
  Mesh = CreateDefaultSubobject<UProceduralMeshComponent>(TEXT("Mesh"));
  RootComponent = Mesh;
}

void AMuslinSheetActor::BeginPlay() {
  Super::BeginPlay();
  Start = GetActorLocation();
  const FVector Right = GetActorRightVector(), Up = GetActorUpVector();
  Check(Sheet.make(uint32(Columns), uint32(Rows), Spacing, {0, 0, 0},
                   {float(Right.X), float(Right.Y), float(Right.Z)},
                   {float(-Up.X), float(-Up.Y), float(-Up.Z)}));
  for (const AActor *Ball : Balls) {
    const auto Made = Sheet.add_sphere(FromStart(Ball->GetActorLocation()), BallRadius);
    Check(Made.status());
    Colliders.push_back(Made.value());
  }
  // The vertices are where the cloth is, however the actor turns or moves.
  Mesh->SetUsingAbsoluteLocation(true);
  Mesh->SetUsingAbsoluteRotation(true);
  Mesh->SetWorldLocationAndRotation(Start, FQuat::Identity);
}

void AMuslinSheetActor::Tick(float Seconds) {
  Super::Tick(Seconds);
  for (size_t i = 0; i < Colliders.size(); i++) {
    Check(Sheet.move_sphere(Colliders[i], FromStart(Balls[int32(i)]->GetActorLocation())));
  }
  Check(Sheet.set_wind({float(Wind.X), float(Wind.Y), float(Wind.Z)}));
  Check(Sheet.advance(Seconds));
  Check(Sheet.update(Sides));
  Draw();
}

void AMuslinSheetActor::Draw() {
  TArray<FVector> Positions, Normals;
  TArray<FVector2D> Uvs;
  for (size_t i = 0; i < Sides.positions.size(); i += 3) {
    Positions.Add(FVector(Sides.positions[i], Sides.positions[i + 1], Sides.positions[i + 2]));
    Normals.Add(FVector(Sides.normals[i], Sides.normals[i + 1], Sides.normals[i + 2]));
  }
  for (size_t i = 0; i < Sides.uvs.size(); i += 2) Uvs.Add(FVector2D(Sides.uvs[i], Sides.uvs[i + 1]));
  if (!Sides.has_new_triangles) {
    Mesh->UpdateMeshSection_LinearColor(0, Positions, Normals, Uvs, {}, {});
    return;
  }
  TArray<int32> Triangles;
  for (const uint32 Index : Sides.triangles) Triangles.Add(int32(Index));
  Mesh->CreateMeshSection_LinearColor(0, Positions, Triangles, Normals, Uvs, {}, {}, false);
}

MuslinVec3 AMuslinSheetActor::FromStart(const FVector &Position) const {
  return {float(Position.X - Start.X), float(Position.Y - Start.Y), float(Position.Z - Start.Z)};
}

void AMuslinSheetActor::Check(MuslinStatus Status) {
  checkf(Status == MUSLIN_STATUS_OK, TEXT("Muslin: %hs"), muslin_last_error());
}
