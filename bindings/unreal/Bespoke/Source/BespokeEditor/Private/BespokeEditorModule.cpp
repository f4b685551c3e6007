#include "BespokeDressing.h"
#include "Framework/Docking/TabManager.h"
#include "IDetailsView.h"
#include "Modules/ModuleManager.h"
#include "PropertyEditorModule.h"
#include "UObject/StrongObjectPtr.h"
#include "Widgets/Docking/SDockTab.h"

/** The tab Bespoke, in the menu Tools. */
class FBespokeEditorModule : public IModuleInterface
{
public:
	virtual void StartupModule() override
	{
		FGlobalTabmanager::Get()
			->RegisterNomadTabSpawner(
				TEXT("Bespoke"), FOnSpawnTab::CreateRaw(this, &FBespokeEditorModule::SpawnTab))
			.SetDisplayName(FText::FromString(TEXT("Bespoke")));
	}

	virtual void ShutdownModule() override
	{
		if (Dressing.IsValid())
		{
			Dressing->Stop();
		}
		Dressing.Reset();
		FGlobalTabmanager::Get()->UnregisterNomadTabSpawner(TEXT("Bespoke"));
	}

private:
	TStrongObjectPtr<UBespokeDressing> Dressing;

	TSharedRef<SDockTab> SpawnTab(const FSpawnTabArgs&)
	{
		if (!Dressing.IsValid())
		{
			Dressing = TStrongObjectPtr<UBespokeDressing>(NewObject<UBespokeDressing>());
		}
		FPropertyEditorModule& Editor = FModuleManager::LoadModuleChecked<FPropertyEditorModule>(TEXT("PropertyEditor"));
		FDetailsViewArgs Arguments;
		Arguments.bHideSelectionTip = true;
		const TSharedRef<IDetailsView> View = Editor.CreateDetailView(Arguments);
		View->SetObject(Dressing.Get());
		return SNew(SDockTab).TabRole(ETabRole::NomadTab)[View];
	}
};

IMPLEMENT_MODULE(FBespokeEditorModule, BespokeEditor)
