#include "BespokeFigures.h"

#include "Engine/SkeletalMesh.h"
#include "GeometryScript/MeshAssetFunctions.h"
#include "GeometryScript/MeshBasicEditFunctions.h"
#include "GeometryScript/MeshBoneWeightFunctions.h"
#include "GeometryScript/MeshNormalsFunctions.h"
#include "GeometryScript/MeshQueryFunctions.h"
#include "UDynamicMesh.h"

namespace BespokeFigures
{

FString Read(USkeletalMesh* Asset, UDynamicMesh* Mesh, BespokeCore::FFigure& Figure)
{
	if (Asset == nullptr)
	{
		return TEXT("a skeletal mesh is missing");
	}
	EGeometryScriptOutcomePins Outcome = EGeometryScriptOutcomePins::Failure;
	UGeometryScriptLibrary_StaticMeshFunctions::CopyMeshFromSkeletalMesh(
		Asset, Mesh, FGeometryScriptCopyMeshFromAssetOptions(), FGeometryScriptMeshReadLOD(), Outcome);
	if (Outcome != EGeometryScriptOutcomePins::Success)
	{
		return Asset->GetName() + TEXT(" cannot be read; in a game, its mesh has to allow CPU access");
	}
	Figure.Name = TCHAR_TO_UTF8(*Asset->GetName());
	FGeometryScriptVectorList Positions;
	FGeometryScriptTriangleList Triangles;
	bool bHasVertexGaps = false;
	bool bHasTriangleGaps = false;
	UGeometryScriptLibrary_MeshQueryFunctions::GetAllVertexPositions(Mesh, Positions, false, bHasVertexGaps);
	UGeometryScriptLibrary_MeshQueryFunctions::GetAllTriangleIndices(Mesh, Triangles, true, bHasTriangleGaps);
	if (bHasVertexGaps)
	{
		return Asset->GetName() + TEXT(" has gaps in the numbers of its vertices; import it again");
	}
	Figure.SetPositions(*Positions.List);
	Figure.SetTriangles(*Triangles.List);

	TArray<FGeometryScriptBoneInfo> Bones;
	UGeometryScriptLibrary_MeshBoneWeightFunctions::GetAllBonesInfo(Mesh, Bones);
	TArray<FTransform> Binds;
	for (const FGeometryScriptBoneInfo& Bone : Bones)
	{
		// Parents come first in a reference skeleton.
		const bool bIsRoot = Bone.ParentIndex < 0;
		Binds.Add(bIsRoot ? Bone.LocalTransform : Bone.LocalTransform * Binds[Bone.ParentIndex]);
		Figure.AddJoint(TCHAR_TO_UTF8(*Bone.Name.ToString()), Bone.ParentIndex, Binds.Last().ToMatrixWithScale());
	}
	for (int32 Vertex = 0; Vertex < Positions.List->Num(); Vertex++)
	{
		TArray<FGeometryScriptBoneWeight> Weights;
		bool bIsBound = false;
		UGeometryScriptLibrary_MeshBoneWeightFunctions::GetVertexBoneWeights(Mesh, Vertex, Weights, bIsBound);
		Figure.AddVertexWeights(Weights);
	}
	return FString();
}

void Write(const BespokeCore::FOutcome& Outcome, UDynamicMesh* Mesh, UDynamicMesh* Wearer)
{
	FGeometryScriptVectorList Positions;
	Positions.Reset();
	for (const auto& Position : Outcome.Positions)
	{
		Positions.List->Add(FVector(Position[0], Position[1], Position[2]));
	}
	UGeometryScriptLibrary_MeshBasicEditFunctions::SetAllMeshVertexPositions(Mesh, Positions);
	UGeometryScriptLibrary_MeshBoneWeightFunctions::CopyBonesFromMesh(Wearer, Mesh);
	for (size_t Vertex = 0; Outcome.Influences > 0 && Vertex < Outcome.Positions.size(); Vertex++)
	{
		TMap<int32, float> Sums;
		for (size_t k = Vertex * Outcome.Influences; k < (Vertex + 1) * Outcome.Influences; k++)
		{
			if (Outcome.SkinWeights[k] > 0.0f)
			{
				Sums.FindOrAdd(static_cast<int32>(Outcome.SkinJoints[k])) += Outcome.SkinWeights[k];
			}
		}
		TArray<FGeometryScriptBoneWeight> Weights;
		for (const TPair<int32, float>& Sum : Sums)
		{
			FGeometryScriptBoneWeight Weight;
			Weight.BoneIndex = Sum.Key;
			Weight.Weight = Sum.Value;
			Weights.Add(Weight);
		}
		bool bIsThere = false;
		UGeometryScriptLibrary_MeshBoneWeightFunctions::SetVertexBoneWeights(
			Mesh, static_cast<int32>(Vertex), Weights, bIsThere);
	}
	UGeometryScriptLibrary_MeshNormalsFunctions::RecomputeNormals(Mesh, FGeometryScriptCalculateNormalsOptions());
}

} // namespace BespokeFigures
