// The editor's tab.
using UnrealBuildTool;

public class BespokeEditor : ModuleRules
{
    public BespokeEditor(ReadOnlyTargetRules Target) : base(Target)
    {
        PCHUsage = PCHUsageMode.UseExplicitOrSharedPCHs;
        CppStandard = CppStandardVersion.Cpp20;
        PrivateDependencyModuleNames.AddRange(new string[]
        {
            "Core", "CoreUObject", "Engine", "Slate", "SlateCore", "InputCore", "UnrealEd", "PropertyEditor",
            "GeometryFramework", "GeometryScriptingCore", "GeometryScriptingEditor", "Bespoke",
        });
    }
}
