// Garments of one character on another, for Blueprints and C++.
#pragma once

#include "CoreMinimal.h"
#include "UObject/Object.h"

#include <atomic>

#include "BespokeRetarget.generated.h"

class UDynamicMesh;
class USkeletalMesh;
struct FBespokeRun;

/** How far it is, from 0 to 1, and in words. */
DECLARE_DYNAMIC_MULTICAST_DELEGATE_TwoParams(FBespokeProgressed, float, Share, const FString&, Words);
/** All is done; Results has what came of it. */
DECLARE_DYNAMIC_MULTICAST_DELEGATE(FBespokeFinished);
/** A garment is not dressed, or not as designed: why, and the section of docs/troubleshooting.md. */
DECLARE_DYNAMIC_MULTICAST_DELEGATE_ThreeParams(
	FBespokeFailed, USkeletalMesh*, Garment, const FString&, Message, const FString&, Section);

/**
 * Puts garments that were made for one character on another, with no triangle through another. Fill in the properties, bind the
 * events, call Start: the fitting is done in threads of its own. Events come in the game thread.
 */
UCLASS(BlueprintType)
class BESPOKE_API UBespokeRetarget : public UObject
{
	GENERATED_BODY()

public:
	/** Innermost first. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Bespoke", meta = (DisplayName = "Garments, innermost first"))
	TArray<TObjectPtr<USkeletalMesh>> Garments;

	/** The body that they were made for. None: it is not there, and the fit is tight. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Bespoke", meta = (DisplayName = "Made for"))
	TObjectPtr<USkeletalMesh> MadeFor;

	/** The body to dress. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Bespoke", meta = (DisplayName = "To be worn by"))
	TObjectPtr<USkeletalMesh> WornBy;

	/** Weight of the fit term, higher is tighter. Default 2. 0: no fit. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Bespoke", meta = (ClampMin = "0"))
	double Fit = 2.0;

	/**
	 * Where a source avatar is given: the clearance that the fit aims at, as a fraction of the one that each point
	 * of the garment had on it, in proportion to the limb there [up to 2]. Default 1, as designed. 0: tight, as
	 * without a source avatar.
	 */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Bespoke", meta = (ClampMin = "0", ClampMax = "2"))
	double Looseness = 1.0;

	/**
	 * Clearance to aim at everywhere, in addition to the designed one, in the target's unit, from 0 to half the size
	 * of the target skeleton. What is nearer is pushed away, what is farther is drawn in. Default 0.
	 */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Bespoke", meta = (ClampMin = "0"))
	double Offset = 0.0;

	/** Bones of the body that they were made for and those of the wearer that correspond; None as the second: nothing does. */
	UPROPERTY(EditAnywhere, BlueprintReadWrite, Category = "Bespoke", meta = (DisplayName = "Matching Bones"))
	TMap<FName, FName> Pairs;

	/** For each garment, its mesh on the wearer's bones; null where it is not dressed. */
	UPROPERTY(BlueprintReadOnly, Category = "Bespoke")
	TArray<TObjectPtr<UDynamicMesh>> Results;

	/** What the library has to say, garment after garment. */
	UPROPERTY(BlueprintReadOnly, Category = "Bespoke")
	TArray<FString> Findings;

	UPROPERTY(BlueprintAssignable, Category = "Bespoke")
	FBespokeProgressed OnProgress;

	UPROPERTY(BlueprintAssignable, Category = "Bespoke")
	FBespokeFinished OnFinished;

	UPROPERTY(BlueprintAssignable, Category = "Bespoke")
	FBespokeFailed OnFailed;

	/** Reads all meshes and begins. Whether it could: OnFailed says why not. */
	UFUNCTION(BlueprintCallable, Category = "Bespoke")
	bool Start();

	/** Ends it within 100 ms. What was dressed before stays. */
	UFUNCTION(BlueprintCallable, Category = "Bespoke")
	void Stop();

	/** Whether it runs. */
	UFUNCTION(BlueprintPure, Category = "Bespoke")
	bool IsRunning() const;

	virtual void BeginDestroy() override;

private:
	TSharedPtr<FBespokeRun> Run;

	void Finish(int32 Garment);
	void End();
};
