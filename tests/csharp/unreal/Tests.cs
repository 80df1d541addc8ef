// Muslin.Build.cs takes the package of each platform, and says which one is missing.

using System;
using System.IO;
using System.Linq;
using UnrealBuildTool;

static class Tests
{
    static int Main()
    {
        string dir = Path.Combine(Path.GetTempPath(), "muslin-" + Guid.NewGuid());
        ModuleRules.directory = dir;
        string[] names = { "x86_64-pc-windows-gnu", "x86_64-unknown-linux-gnu", "aarch64-apple-darwin" };
        foreach (string name in names) Directory.CreateDirectory(Path.Combine(dir, "muslin-1.2.3-" + name));
        try
        {
            Muslin windows = Make(UnrealTargetPlatform.Win64, UnrealArch.X64);
            Equal("muslin-1.2.3-x86_64-pc-windows-gnu/lib/muslin.lib", Inside(dir, windows.PublicAdditionalLibraries.Single()));
            Equal("muslin-1.2.3-x86_64-pc-windows-gnu/bin/muslin.dll", Inside(dir, windows.RuntimeDependencies.copied.Single()));
            Muslin linux = Make(UnrealTargetPlatform.Linux, UnrealArch.X64);
            Equal("muslin-1.2.3-x86_64-unknown-linux-gnu/lib/libmuslin.a", Inside(dir, linux.PublicAdditionalLibraries.Single()));
            Equal("muslin-1.2.3-x86_64-unknown-linux-gnu/include", Inside(dir, linux.PublicSystemIncludePaths.Single()));
            Equal("External", linux.Type.ToString());
            Make(UnrealTargetPlatform.Mac, UnrealArch.Arm64);
            Refused(UnrealTargetPlatform.Mac, UnrealArch.X64, "unpack one release package for x86_64-apple-darwin in " + dir);
            Refused(UnrealTargetPlatform.TVOS, UnrealArch.Arm64, "there is no release package for TVOS");
        }
        finally
        {
            Directory.Delete(dir, true);
        }
        Console.WriteLine("  ok Muslin.Build.cs");
        return 0;
    }

    static Muslin Make(UnrealTargetPlatform platform, UnrealArch architecture)
    {
        return new Muslin(new ReadOnlyTargetRules { Platform = platform, Architecture = architecture });
    }

    static void Refused(UnrealTargetPlatform platform, UnrealArch architecture, string why)
    {
        try
        {
            Make(platform, architecture);
        }
        catch (BuildException error)
        {
            Equal("Muslin: " + why, error.Message);
            return;
        }
        throw new Exception(platform + " is not refused");
    }

    static string Inside(string dir, string path)
    {
        return path.Substring(dir.Length + 1).Replace('\\', '/');
    }

    static void Equal(string wanted, string found)
    {
        if (wanted != found) throw new Exception("expected " + wanted + ", found " + found);
    }
}
