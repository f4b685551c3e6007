#include "BespokeDressing.h"

#include "Engine/SkeletalMesh.h"
#include "GeometryScript/CreateNewAssetUtilityFunctions.h"
#include "UDynamicMesh.h"

UBespokeDressing::UBespokeDressing()
{
	OnProgress.AddDynamic(this, &UBespokeDressing::Show);
	OnFailed.AddDynamic(this, &UBespokeDressing::Tell);
	OnFinished.AddDynamic(this, &UBespokeDressing::MakeAssets);
}

void UBespokeDressing::DressNow()
{
	Trouble.Reset();
	State = Start() ? FString(TEXT("preparing")) : Trouble;
}

void UBespokeDressing::StopNow()
{
	Stop();
}

void UBespokeDressing::Show(float Share, const FString& Words)
{
	State = FString::Printf(TEXT("%s (%.0f %%)"), *Words, 100.0f * Share);
}

void UBespokeDressing::Tell(USkeletalMesh* Garment, const FString& Message, const FString& Section)
{
	const FString Name = Garment != nullptr ? Garment->GetName() + TEXT(": ") : FString();
	Trouble += Name + Message + TEXT("\nWhat to do: docs/troubleshooting.md#") + Section + TEXT("\n");
}

void UBespokeDressing::MakeAssets()
{
	FString Made;
	for (int32 k = 0; k < Results.Num(); k++)
	{
		if (Results[k] == nullptr || !Garments.IsValidIndex(k) || Garments[k] == nullptr || WornBy == nullptr)
		{
			continue;
		}
		FGeometryScriptCreateNewSkeletalMeshAssetOptions Options;
		Options.bUseMeshBoneProportions = true;
		for (const FSkeletalMaterial& Slot : Garments[k]->GetMaterials())
		{
			Options.Materials.Add(Slot.MaterialSlotName, Slot.MaterialInterface);
		}
		FGeometryScriptUniqueAssetNameOptions Unique;
		FString Path;
		FString Name;
		EGeometryScriptOutcomePins Outcome = EGeometryScriptOutcomePins::Failure;
		UGeometryScriptLibrary_CreateNewAssetFunctions::CreateUniqueNewAssetPathName(
			Folder, Garments[k]->GetName() + TEXT("_on_") + WornBy->GetName(), Path, Name, Unique, Outcome);
		if (Outcome == EGeometryScriptOutcomePins::Success)
		{
			UGeometryScriptLibrary_CreateNewAssetFunctions::CreateNewSkeletalMeshAssetFromMesh(
				Results[k], WornBy->GetSkeleton(), Path, Options, Outcome);
		}
		const bool bIsThere = Outcome == EGeometryScriptOutcomePins::Success;
		Made += bIsThere ? Path + TEXT("\n") : FString(TEXT("an asset could not be made; the output log says why\n"));
	}
	State = Made + Trouble;
	for (const FString& Found : Findings)
	{
		State += Found + TEXT("\n");
	}
}
