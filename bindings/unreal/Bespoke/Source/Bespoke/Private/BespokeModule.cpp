#include "HAL/PlatformProcess.h"
#include "Interfaces/IPluginManager.h"
#include "Misc/Paths.h"
#include "Modules/ModuleManager.h"

/** Loads the library from the plugin's folder before anything of it is called: on Windows it is linked with delay. */
class FBespokeModule : public IModuleInterface
{
public:
	virtual void StartupModule() override
	{
#if PLATFORM_WINDOWS
		const TSharedPtr<IPlugin> Plugin = IPluginManager::Get().FindPlugin(TEXT("Bespoke"));
		const FString Folder = Plugin.IsValid() ? Plugin->GetBaseDir() : FString();
		const FString Path = FPaths::Combine(Folder, TEXT("Source/ThirdParty/BespokeLibrary/lib/Win64/bespoke.dll"));
		Library = FPlatformProcess::GetDllHandle(*Path);
		if (Library == nullptr)
		{
			UE_LOG(LogTemp, Error, TEXT("Bespoke: %s cannot be loaded; nothing of the plugin works without it"), *Path);
		}
#endif
	}

	virtual void ShutdownModule() override
	{
		if (Library != nullptr)
		{
			FPlatformProcess::FreeDllHandle(Library);
			Library = nullptr;
		}
	}

private:
	void* Library = nullptr;
};

IMPLEMENT_MODULE(FBespokeModule, Bespoke)
