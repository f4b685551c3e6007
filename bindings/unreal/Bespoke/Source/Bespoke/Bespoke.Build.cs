// What works in games too: the core, and UBespokeRetarget over dynamic meshes.
using UnrealBuildTool;

public class Bespoke : ModuleRules
{
    public Bespoke(ReadOnlyTargetRules Target) : base(Target)
    {
        PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
        CppStandard = CppStandardVersion.Cpp20;
        PublicDependencyModuleNames.AddRange(new string[]
        {
            "Core", "CoreUObject", "Engine", "GeometryCore", "GeometryFramework", "GeometryScriptingCore", "BespokeLibrary",
        });
        PrivateDependencyModuleNames.Add("Projects");
    }
}
