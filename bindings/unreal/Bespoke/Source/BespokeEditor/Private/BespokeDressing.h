// What the tab shows: the details of this object.
#pragma once

#include "BespokeRetarget.h"
#include "CoreMinimal.h"

#include "BespokeDressing.generated.h"

/** Garments onto another character, as new assets. */
UCLASS()
class UBespokeDressing : public UBespokeRetarget
{
	GENERATED_BODY()

public:
	UBespokeDressing();

	/** Where the new assets go. */
	UPROPERTY(EditAnywhere, Category = "Bespoke")
	FString Folder = TEXT("/Game/Bespoke");

	/** How far it is, and what came of it. */
	UPROPERTY(VisibleAnywhere, Category = "Bespoke", meta = (MultiLine = "true"))
	FString State;

	/** Puts the garments on the other character: new assets on its skeleton, with no triangle through another. */
	UFUNCTION(CallInEditor, Category = "Bespoke", meta = (DisplayName = "Dress"))
	void DressNow();

	/** Ends it at once; what is dressed already stays. */
	UFUNCTION(CallInEditor, Category = "Bespoke", meta = (DisplayName = "Stop"))
	void StopNow();

private:
	UFUNCTION()
	void Show(float Share, const FString& Words);

	UFUNCTION()
	void Tell(USkeletalMesh* Garment, const FString& Message, const FString& Section);

	UFUNCTION()
	void MakeAssets();

	FString Trouble;
};
