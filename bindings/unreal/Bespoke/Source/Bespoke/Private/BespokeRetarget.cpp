#include "BespokeRetarget.h"

#include "Async/Async.h"
#include "BespokeFigures.h"
#include "Engine/SkeletalMesh.h"
#include "UDynamicMesh.h"
#include "UObject/StrongObjectPtr.h"
#include "UObject/WeakObjectPtr.h"

/** What the thread works on; nothing of it is a UObject. */
struct FBespokeRun
{
	BespokeCore::FFigure MadeFor;
	BespokeCore::FFigure WornBy;
	std::vector<BespokeCore::FFigure> Garments;
	std::vector<BespokeCore::FOutcome> Outcomes;
	std::vector<std::array<std::uint32_t, 2>> Pairs;
	BespokeCore::FDials Dials;
	bool bHasMadeFor = false;
	bespoke::StopSource Source;
	TStrongObjectPtr<UDynamicMesh> Wearer;
	TArray<TStrongObjectPtr<UDynamicMesh>> Meshes;
};

namespace
{

std::uint32_t FindJoint(const BespokeCore::FFigure& Figure, const FName& Name)
{
	const std::string Wanted = TCHAR_TO_UTF8(*Name.ToString());
	for (std::uint32_t k = 0; k < Figure.Joints.size(); k++)
	{
		if (Figure.Joints[k].name == Wanted)
		{
			return k;
		}
	}
	return bespoke::no_joint;
}

} // namespace

bool UBespokeRetarget::Start()
{
	if (Run.IsValid())
	{
		OnFailed.Broadcast(nullptr, TEXT("it is running already; Stop ends it"), TEXT("bespoke_status_busy"));
		return false;
	}
	TSharedPtr<FBespokeRun> Next = MakeShared<FBespokeRun>();
	const auto Refuse = [this](USkeletalMesh* Mesh, const FString& Why) {
		OnFailed.Broadcast(Mesh, Why, TEXT("bespoke_status_invalid_argument"));
		return false;
	};
	if (Garments.Num() == 0)
	{
		return Refuse(nullptr, TEXT("no garment is chosen"));
	}
	Next->Wearer = TStrongObjectPtr<UDynamicMesh>(NewObject<UDynamicMesh>());
	if (const FString Why = BespokeFigures::Read(WornBy, Next->Wearer.Get(), Next->WornBy); !Why.IsEmpty())
	{
		return Refuse(WornBy, Why);
	}
	if (MadeFor != nullptr)
	{
		const TStrongObjectPtr<UDynamicMesh> Mesh(NewObject<UDynamicMesh>());
		if (const FString Why = BespokeFigures::Read(MadeFor, Mesh.Get(), Next->MadeFor); !Why.IsEmpty())
		{
			return Refuse(MadeFor, Why);
		}
		Next->bHasMadeFor = true;
	}
	for (USkeletalMesh* Garment : Garments)
	{
		Next->Meshes.Add(TStrongObjectPtr<UDynamicMesh>(NewObject<UDynamicMesh>()));
		Next->Garments.emplace_back();
		if (const FString Why = BespokeFigures::Read(Garment, Next->Meshes.Last().Get(), Next->Garments.back());
			!Why.IsEmpty())
		{
			return Refuse(Garment, Why);
		}
	}
	const BespokeCore::FFigure& Source = Next->bHasMadeFor ? Next->MadeFor : Next->Garments.front();
	for (const TPair<FName, FName>& Pair : Pairs)
	{
		const std::uint32_t From = FindJoint(Source, Pair.Key);
		const std::uint32_t To = Pair.Value.IsNone() ? bespoke::no_joint : FindJoint(Next->WornBy, Pair.Value);
		if (From == bespoke::no_joint || (To == bespoke::no_joint && !Pair.Value.IsNone()))
		{
			const FName& Missing = From == bespoke::no_joint ? Pair.Key : Pair.Value;
			return Refuse(nullptr, FString(TEXT("there is no bone ")) + Missing.ToString());
		}
		Next->Pairs.push_back({From, To});
	}
	Next->Dials.Fit = Fit;
	Next->Dials.Looseness = Looseness;
	Next->Dials.Offset = Offset;
	Results.Reset();
	Findings.Reset();
	Run = Next;

	TWeakObjectPtr<UBespokeRetarget> Weak(this);
	Async(EAsyncExecution::Thread, [Weak, Next]() {
		std::vector<BespokeCore::FLayer> Layers;
		const int32 Count = static_cast<int32>(Next->Garments.size());
		for (int32 k = 0; k < Count && !Next->Source.stop_requested(); k++)
		{
			BespokeCore::FTask Task;
			Task.Garment = &Next->Garments[static_cast<size_t>(k)];
			Task.MadeFor = Next->bHasMadeFor ? &Next->MadeFor : nullptr;
			Task.WornBy = &Next->WornBy;
			Task.Layers = &Layers;
			Task.Pairs = Next->Pairs;
			Task.Dials = Next->Dials;
			Next->Outcomes.push_back(BespokeCore::Dress(
				Task, Next->Source.get_token(), [Weak, k, Count, &Task](double Share, const char* Words) {
					const float All = static_cast<float>((k + Share) / Count);
					const FString Said = FString(UTF8_TO_TCHAR(Task.Garment->Name.c_str())) + TEXT(": ") + UTF8_TO_TCHAR(Words);
					AsyncTask(ENamedThreads::GameThread, [Weak, All, Said]() {
						if (UBespokeRetarget* Retarget = Weak.Get())
						{
							Retarget->OnProgress.Broadcast(All, Said);
						}
					});
				}));
			const BespokeCore::FOutcome& Outcome = Next->Outcomes.back();
			if (Outcome.bDressed)
			{
				Layers.push_back({Outcome.Positions, Task.Garment->Triangles});
			}
		}
		AsyncTask(ENamedThreads::GameThread, [Weak, Next]() {
			UBespokeRetarget* Retarget = Weak.Get();
			if (Retarget != nullptr && Retarget->Run == Next)
			{
				Retarget->End();
			}
		});
	});
	return true;
}

void UBespokeRetarget::Stop()
{
	if (Run.IsValid())
	{
		Run->Source.request_stop();
	}
}

bool UBespokeRetarget::IsRunning() const
{
	return Run.IsValid();
}

void UBespokeRetarget::BeginDestroy()
{
	// The thread keeps what it works on, and ends by itself.
	Stop();
	Super::BeginDestroy();
}

void UBespokeRetarget::Finish(int32 Garment)
{
	const BespokeCore::FOutcome& Outcome = Run->Outcomes[static_cast<size_t>(Garment)];
	const FString Name = UTF8_TO_TCHAR(Run->Garments[static_cast<size_t>(Garment)].Name.c_str());
	for (const bespoke::Diagnostic& Found : Outcome.Findings)
	{
		Findings.Add(Name + TEXT(": ") + UTF8_TO_TCHAR(Found.message.c_str()));
	}
	UDynamicMesh* Mesh = nullptr;
	if (Outcome.bDressed)
	{
		Mesh = Run->Meshes[Garment].Get();
		BespokeFigures::Write(Outcome, Mesh, Run->Wearer.Get());
	}
	Results.Add(Mesh);
	if (Outcome.Status != bespoke::Status::ok && Outcome.Status != bespoke::Status::cancelled)
	{
		OnFailed.Broadcast(Garments.IsValidIndex(Garment) ? Garments[Garment].Get() : nullptr,
			UTF8_TO_TCHAR(Outcome.Message.c_str()), UTF8_TO_TCHAR(BespokeCore::Anchor(Outcome.Status).c_str()));
	}
}

void UBespokeRetarget::End()
{
	for (int32 k = 0; k < static_cast<int32>(Run->Outcomes.size()); k++)
	{
		Finish(k);
	}
	Run.Reset();
	OnFinished.Broadcast();
}
