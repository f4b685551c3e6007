// What of UnrealBuildTool the plugin's Build.cs files use, so that they can be compiled. Nothing here does anything.
using System.Collections.Generic;

namespace UnrealBuildTool
{
    public enum CppStandardVersion { Cpp20 }

    public struct UnrealTargetPlatform
    {
        public static readonly UnrealTargetPlatform Win64, Linux;
        public static bool operator ==(UnrealTargetPlatform a, UnrealTargetPlatform b) { return true; }
        public static bool operator !=(UnrealTargetPlatform a, UnrealTargetPlatform b) { return false; }
        public override bool Equals(object other) { return true; }
        public override int GetHashCode() { return 0; }
    }

    public sealed class ReadOnlyTargetRules { public UnrealTargetPlatform Platform; }

    public class RuntimeDependencyList { public void Add(string path) { } }

    public class ModuleRules
    {
        public enum ModuleType { CPlusPlus, External }
        public enum PCHUsageMode { UseExplicitOrSharedPCHs }
        public ModuleRules(ReadOnlyTargetRules Target) { }
        public ModuleType Type;
        public PCHUsageMode PCHUsage;
        public CppStandardVersion CppStandard;
        public string ModuleDirectory = "";
        public List<string> PublicSystemIncludePaths = new List<string>();
        public List<string> PublicAdditionalLibraries = new List<string>();
        public List<string> PublicDelayLoadDLLs = new List<string>();
        public List<string> PublicRuntimeLibraryPaths = new List<string>();
        public List<string> PublicDependencyModuleNames = new List<string>();
        public List<string> PrivateDependencyModuleNames = new List<string>();
        public RuntimeDependencyList RuntimeDependencies = new RuntimeDependencyList();
    }
}
