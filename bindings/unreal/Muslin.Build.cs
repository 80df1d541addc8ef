// Links the C library into an Unreal project. This file lies in Source/ThirdParty/Muslin, beside the
// unpacked release packages, such as muslin-0.1.0-x86_64-pc-windows-gnu. See docs/manual/unreal.md.

using System.IO;
using UnrealBuildTool;

public class Muslin : ModuleRules
{
    public Muslin(ReadOnlyTargetRules Target) : base(Target)
    {
        Type = ModuleType.External;
        string name = NameOf(Target);
        string[] found = Directory.GetDirectories(ModuleDirectory, "muslin-*-" + name);
        if (found.Length != 1)
        {
            throw new BuildException("Muslin: unpack one release package for {0} in {1}", name, ModuleDirectory);
        }
        string package = found[0];
        PublicSystemIncludePaths.Add(Path.Combine(package, "include"));
        if (Target.Platform == UnrealTargetPlatform.Win64)
        {
            PublicAdditionalLibraries.Add(Path.Combine(package, "lib", "muslin.lib"));
            RuntimeDependencies.Add("$(TargetOutputDir)/muslin.dll", Path.Combine(package, "bin", "muslin.dll"));
        }
        else
        {
            PublicAdditionalLibraries.Add(Path.Combine(package, "lib", "libmuslin.a"));
        }
    }

    /// <summary>The name of a platform in the names of packages.</summary>
    static string NameOf(ReadOnlyTargetRules target)
    {
        bool isArm = target.Architecture == UnrealArch.Arm64;
        if (target.Platform == UnrealTargetPlatform.Win64 && !isArm) return "x86_64-pc-windows-gnu";
        if (target.Platform == UnrealTargetPlatform.Mac) return isArm ? "aarch64-apple-darwin" : "x86_64-apple-darwin";
        if (target.Platform == UnrealTargetPlatform.Linux) return "x86_64-unknown-linux-gnu";
        if (target.Platform == UnrealTargetPlatform.LinuxArm64) return "aarch64-unknown-linux-gnu";
        if (target.Platform == UnrealTargetPlatform.IOS) return "aarch64-apple-ios";
        if (target.Platform == UnrealTargetPlatform.Android) return isArm ? "aarch64-linux-android" : "x86_64-linux-android";
        throw new BuildException("Muslin: there is no release package for {0}", target.Platform);
    }
}
