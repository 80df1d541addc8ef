// The classes of Unity that the example uses, as far as it uses them, with the signatures of Unity
// 2022. They keep what they are given, so that the test can look at it. Unity itself is not here.

using System;
using System.Collections.Generic;

namespace UnityEngine.Rendering
{
    public enum IndexFormat { UInt16, UInt32 }

    public enum VertexAttribute { Position, Normal, Tangent, Color, TexCoord0 }

    public enum VertexAttributeFormat { Float32, Float16 }

    public enum MeshUpdateFlags { Default }

    public struct VertexAttributeDescriptor
    {
        public int dimension;

        public VertexAttributeDescriptor(VertexAttribute attribute, VertexAttributeFormat format, int dimension, int stream = 0)
        {
            this.dimension = dimension;
        }
    }

    public struct SubMeshDescriptor
    {
        public int indexCount;

        public SubMeshDescriptor(int indexStart, int indexCount, MeshTopology topology = MeshTopology.Triangles)
        {
            this.indexCount = indexCount;
        }
    }
}

namespace UnityEngine
{
    using Rendering;

    public enum MeshTopology { Triangles }

    public sealed class RequireComponent : Attribute
    {
        public RequireComponent(Type first, Type second) { }
    }

    public sealed class TooltipAttribute : Attribute
    {
        public TooltipAttribute(string tooltip) { }
    }

    public sealed class MinAttribute : Attribute
    {
        public MinAttribute(float min) { }
    }

    public struct Vector3
    {
        public float x, y, z;

        public Vector3(float x, float y, float z)
        {
            this.x = x;
            this.y = y;
            this.z = z;
        }

        public static Vector3 operator -(Vector3 v)
        {
            return new Vector3(-v.x, -v.y, -v.z);
        }
    }

    public struct Quaternion
    {
        public float x, y, z, w;
    }

    public struct Matrix4x4
    {
        public float[] rows;

        public float this[int row, int column]
        {
            get { return rows[4 * row + column]; }
        }
    }

    public class Object
    {
        public bool isDestroyed;

        public static void Destroy(Object one)
        {
            one.isDestroyed = true;
        }
    }

    public class Component : Object
    {
        public GameObject gameObject;

        public Transform transform
        {
            get { return gameObject.transform; }
        }

        public T GetComponent<T>() where T : Component, new()
        {
            return gameObject.Get<T>();
        }
    }

    public class MonoBehaviour : Component { }

    public sealed class GameObject : Object
    {
        public readonly Transform transform = new Transform();
        readonly Dictionary<Type, Component> components = new Dictionary<Type, Component>();

        public T Get<T>() where T : Component, new()
        {
            if (!components.ContainsKey(typeof(T))) components[typeof(T)] = new T { gameObject = this };
            return (T)components[typeof(T)];
        }
    }

    /// <summary>A place, turned by half a turn about y if `isTurned`.</summary>
    public sealed class Transform
    {
        public Vector3 position;
        public bool isTurned;
        public Vector3 lossyScale = new Vector3(1, 1, 1);

        public Vector3 right { get { return new Vector3(isTurned ? -1 : 1, 0, 0); } }

        public Vector3 up { get { return new Vector3(0, 1, 0); } }

        public Quaternion rotation
        {
            get { return isTurned ? new Quaternion { y = 1 } : new Quaternion { w = 1 }; }
        }

        public Matrix4x4 worldToLocalMatrix
        {
            get
            {
                float s = isTurned ? -1 : 1;
                Vector3 p = position;
                return new Matrix4x4 { rows = new[] { s, 0, 0, -s * p.x, 0, 1, 0, -p.y, 0, 0, s, -s * p.z, 0, 0, 0, 1 } };
            }
        }

        public Vector3 TransformPoint(Vector3 p)
        {
            float s = isTurned ? -1 : 1;
            return new Vector3(position.x + s * p.x, position.y + p.y, position.z + s * p.z);
        }
    }

    public sealed class MeshFilter : Component
    {
        public Mesh sharedMesh;
    }

    public sealed class MeshRenderer : Component { }

    public sealed class SphereCollider : Component
    {
        public Vector3 center;
        public float radius = 0.5f;
    }

    public static class Time
    {
        public static float deltaTime;
    }

    public sealed class Mesh : Object
    {
        public float[] vertices;
        public uint[] indices;
        public int vertexUploads, indexUploads, subMeshCount, drawnIndices;
        int stride;

        public void MarkDynamic() { }

        public void SetVertexBufferParams(int vertexCount, params VertexAttributeDescriptor[] attributes)
        {
            foreach (VertexAttributeDescriptor one in attributes) stride += one.dimension;
            vertices = new float[vertexCount * stride];
        }

        public void SetIndexBufferParams(int indexCount, IndexFormat format)
        {
            indices = new uint[indexCount];
        }

        public void SetVertexBufferData<T>(
            T[] data, int dataStart, int meshBufferStart, int count, int stream = 0, MeshUpdateFlags flags = MeshUpdateFlags.Default)
            where T : struct
        {
            Array.Copy(data, dataStart, vertices, meshBufferStart, count);
            vertexUploads++;
        }

        public void SetIndexBufferData<T>(
            T[] data, int dataStart, int meshBufferStart, int count, MeshUpdateFlags flags = MeshUpdateFlags.Default)
            where T : struct
        {
            Array.Copy(data, dataStart, indices, meshBufferStart, count);
            indexUploads++;
        }

        public void SetSubMesh(int index, SubMeshDescriptor desc, MeshUpdateFlags flags = MeshUpdateFlags.Default)
        {
            drawnIndices = desc.indexCount;
        }

        public void RecalculateBounds() { }
    }
}
