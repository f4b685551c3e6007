// The library as it is shipped: header, and one file for each platform.
using System.IO;
using UnrealBuildTool;

public class BespokeLibrary : ModuleRules
{
    public BespokeLibrary(ReadOnlyTargetRules Target) : base(Target)
    {
        Type = ModuleType.External;
        PublicSystemIncludePaths.Add(Path.Combine(ModuleDirectory, "include"));
        string Libraries = Path.Combine(ModuleDirectory, "lib", Target.Platform.ToString());
        if (Target.Platform == UnrealTargetPlatform.Win64)
        {
            // Loaded by the plugin from its own folder: see BespokeModule.cpp.
            PublicAdditionalLibraries.Add(Path.Combine(Libraries, "bespoke.lib"));
            PublicDelayLoadDLLs.Add("bespoke.dll");
            RuntimeDependencies.Add(Path.Combine(Libraries, "bespoke.dll"));
        }
        else if (Target.Platform == UnrealTargetPlatform.Linux)
        {
            // Linked by the one name; the loader looks for the other, which holds the version of the binary interface.
            PublicAdditionalLibraries.Add(Path.Combine(Libraries, "libbespoke.so"));
            PublicRuntimeLibraryPaths.Add(Libraries);
            foreach (string Name in Directory.GetFiles(Libraries, "libbespoke.so*"))
            {
                RuntimeDependencies.Add(Name);
            }
        }
    }
}
