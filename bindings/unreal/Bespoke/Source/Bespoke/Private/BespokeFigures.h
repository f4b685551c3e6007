// Between dynamic meshes and the core.
#pragma once

#include "BespokeCore.h"
#include "CoreMinimal.h"

class UDynamicMesh;
class USkeletalMesh;

namespace BespokeFigures
{

/** Reads a skeletal mesh into a dynamic mesh and a figure. Empty on success, else what is wrong with it. */
FString Read(USkeletalMesh* Asset, UDynamicMesh* Mesh, BespokeCore::FFigure& Figure);

/** Moves a garment's dynamic mesh to where it is worn, on the wearer's bones; materials, UVs and hard edges stay. */
void Write(const BespokeCore::FOutcome& Outcome, UDynamicMesh* Mesh, UDynamicMesh* Wearer);

} // namespace BespokeFigures
