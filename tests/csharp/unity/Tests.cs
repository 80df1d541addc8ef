// The example MuslinSheet.cs in a scene: two seconds in the wind, with a ball that moves into it.

using System;
using System.Reflection;
using UnityEngine;

static class Tests
{
    const int Stride = 8;

    static int Main()
    {
        var ball = new GameObject();
        ball.transform.position = new Vector3(11, 1, 7.4f);
        var sheet = new GameObject();
        sheet.transform.position = new Vector3(12, 2, 7);
        sheet.transform.isTurned = true;
        var component = sheet.Get<MuslinSheet>();
        component.wind = new Vector3();
        component.spheres = new[] { ball.Get<SphereCollider>() };
        component.spheres[0].radius = 0.2f;
        Time.deltaTime = 1 / 60f;
        Call(component, "OnEnable");
        for (int frame = 0; frame < 120; frame++)
        {
            ball.transform.position.z -= 0.005f;
            Call(component, "Update");
        }

        Mesh mesh = sheet.Get<MeshFilter>().sharedMesh;
        Check(mesh.vertexUploads == 120, "the vertices are uploaded in each frame");
        Check(mesh.indexUploads == 1 && mesh.subMeshCount == 1, "the indices are uploaded once");
        Check(mesh.drawnIndices == 6 * 39 * 39, "two triangles per cell are drawn");
        float[] v = mesh.vertices;
        Check(v[0] == 0 && v[1] == 0 && v[2] == 0, "the first corner is pinned at the origin of the object");
        // The ball is at (11, 1, 6.8) in the world, so at (1, -1, 0.2) in the turned object.
        double gap = double.PositiveInfinity, bulge = 0;
        for (int i = 0; i < 1600 * Stride; i += Stride)
        {
            double[] from = { v[i] - 1, v[i + 1] + 1, v[i + 2] - 0.2 };
            gap = Math.Min(gap, Math.Sqrt(from[0] * from[0] + from[1] * from[1] + from[2] * from[2]) - 0.2);
            bulge = Math.Max(bulge, v[i + 2]);
            double length = v[i + 3] * v[i + 3] + v[i + 4] * v[i + 4] + v[i + 5] * v[i + 5];
            Check(Math.Abs(length - 1) < 1e-4, "normals have length 1");
        }
        Check(gap > -0.005 && gap < 0.02, "the ball touches the cloth, at " + gap + " m");
        Check(bulge > 0.3, "the ball pushes the cloth, by " + bulge + " m");

        component.spheres[0].radius = -1;
        Call(component, "OnDisable");
        Check(mesh.isDestroyed, "the mesh is destroyed");
        try
        {
            Call(component, "OnEnable");
            Check(false, "a wrong radius is refused");
        }
        catch (TargetInvocationException error)
        {
            Check(error.InnerException.Message.Contains("radius"), error.InnerException.Message);
        }
        Console.WriteLine("  ok MuslinSheet");
        return 0;
    }

    /// <summary>Calls a message of Unity, which is a private method.</summary>
    static void Call(object component, string name)
    {
        component.GetType().GetMethod(name, BindingFlags.Instance | BindingFlags.NonPublic).Invoke(component, null);
    }

    static void Check(bool claim, string what)
    {
        if (!claim) throw new Exception("not so: " + what);
    }
}
