// The classes of Unreal's build tool that Muslin.Build.cs uses, as far as it uses them. Unreal itself
// is not here.

using System;
using System.Collections.Generic;

namespace UnrealBuildTool
{
    public enum UnrealTargetPlatform { Win64, Mac, Linux, LinuxArm64, IOS, Android, TVOS }

    public enum UnrealArch { X64, Arm64 }

    public sealed class BuildException : Exception
    {
        public BuildException(string format, params object[] arguments) : base(string.Format(format, arguments)) { }
    }

    public sealed class ReadOnlyTargetRules
    {
        public UnrealTargetPlatform Platform;
        public UnrealArch Architecture;
    }

    public sealed class RuntimeDependencyList
    {
        public readonly List<string> copied = new List<string>();

        public void Add(string path, string source)
        {
            copied.Add(source);
        }
    }

    public class ModuleRules
    {
        public enum ModuleType { CPlusPlus, External }

        public static string directory;
        public readonly string ModuleDirectory = directory;
        public ModuleType Type;
        public readonly List<string> PublicSystemIncludePaths = new List<string>();
        public readonly List<string> PublicAdditionalLibraries = new List<string>();
        public readonly RuntimeDependencyList RuntimeDependencies = new RuntimeDependencyList();

        public ModuleRules(ReadOnlyTargetRules target) { }
    }
}
