// A sheet of cloth in Unity: simulated in world space, drawn with the mesh of this object, pushed by
// sphere colliders of the scene. Needs Muslin.cs, the C library in Assets/Plugins, and "Allow
// 'unsafe' Code" in the player settings.

using System;
using Muslin;
using UnityEngine;
using UnityEngine.Rendering;
using static Muslin.Native;

[RequireComponent(typeof(MeshFilter), typeof(MeshRenderer))]
public sealed unsafe class MuslinSheet : MonoBehaviour
{
    [Tooltip("Particles per row and per column.")]
    [Min(2)] public int columns = 40, rows = 40;
    [Tooltip("Distance between neighbours [m].")]
    public float spacing = 0.05f;
    [Tooltip("Velocity of the air [m/s].")]
    public Vector3 wind = new Vector3(0, 0, 2);
    [Tooltip("Spheres of the scene that push the cloth.")]
    public SphereCollider[] spheres = new SphereCollider[0];

    /// <summary>Bytes of a vertex: position, normal, uv.</summary>
    const int Stride = 32;

    MuslinCloth cloth;
    MuslinCollider[] colliders;
    Mesh mesh;
    float[] vertices;
    uint[] indices;
    uint topology;

    void OnEnable()
    {
        MuslinGridDesc desc;
        muslin_grid_desc_init(&desc);
        desc.columns = (uint)columns;
        desc.rows = (uint)rows;
        desc.spacing = spacing;
        desc.origin = From(transform.position);
        desc.right = From(transform.right);
        desc.down = From(-transform.up);
        desc.pin_mode = MUSLIN_PIN_TOP_CORNERS;
        Check(muslin_material_preset(&desc.material, MUSLIN_PRESET_COTTON));
        fixed (MuslinCloth* made = &cloth) Check(muslin_cloth_create_grid(&desc, made));
        MakeMesh();
        colliders = Array.ConvertAll(spheres, AddSphere);
    }

    /// <summary>Makes buffers that are large enough for every tear.</summary>
    void MakeMesh()
    {
        MuslinView view;
        muslin_view_init(&view);
        Check(muslin_cloth_view(cloth, &view));
        vertices = new float[Stride / sizeof(float) * view.vertex_capacity];
        indices = new uint[view.index_capacity];
        topology = view.topology_revision - 1;
        mesh = new Mesh();
        mesh.MarkDynamic();
        mesh.SetVertexBufferParams(
            (int)view.vertex_capacity,
            new VertexAttributeDescriptor(VertexAttribute.Position, VertexAttributeFormat.Float32, 3),
            new VertexAttributeDescriptor(VertexAttribute.Normal, VertexAttributeFormat.Float32, 3),
            new VertexAttributeDescriptor(VertexAttribute.TexCoord0, VertexAttributeFormat.Float32, 2));
        mesh.SetIndexBufferParams(indices.Length, IndexFormat.UInt32);
        GetComponent<MeshFilter>().sharedMesh = mesh;
    }

    MuslinCollider AddSphere(SphereCollider sphere)
    {
        MuslinColliderDesc desc;
        MuslinCollider made;
        muslin_collider_desc_init(&desc);
        desc.shape = MUSLIN_SHAPE_SPHERE;
        desc.position = From(sphere.transform.TransformPoint(sphere.center));
        desc.radius = sphere.radius * sphere.transform.lossyScale.x;
        Check(muslin_cloth_add_collider(cloth, &desc, &made));
        return made;
    }

    void Update()
    {
        for (int i = 0; i < colliders.Length; i++)
        {
            Transform at = spheres[i].transform;
            var rotation = new MuslinQuat { x = at.rotation.x, y = at.rotation.y, z = at.rotation.z, w = at.rotation.w };
            MuslinVec3 center = From(at.TransformPoint(spheres[i].center));
            Check(muslin_cloth_move_collider(cloth, colliders[i], center, rotation));
        }
        MuslinWind air;
        muslin_wind_init(&air);
        air.velocity = From(wind);
        air.gust = 0.5f;
        Check(muslin_cloth_set_wind(cloth, &air));
        Check(muslin_cloth_advance(cloth, Time.deltaTime, null));
        Draw();
    }

    void Draw()
    {
        MuslinView view;
        muslin_view_init(&view);
        Check(muslin_cloth_view(cloth, &view));
        MuslinWriteDesc desc;
        muslin_write_desc_init(&desc);
        Check(muslin_cloth_get_blend(cloth, &desc.blend));
        Matrix4x4 toLocal = transform.worldToLocalMatrix;
        for (int i = 0; i < 12; i++) desc.transform[i] = toLocal[i / 4, i % 4];
        fixed (float* to = vertices)
        {
            MuslinStream* streams = stackalloc MuslinStream[3];
            streams[0] = Stream(MUSLIN_ATTRIBUTE_POSITION, to, 0);
            streams[1] = Stream(MUSLIN_ATTRIBUTE_NORMAL, to, 3);
            streams[2] = Stream(MUSLIN_ATTRIBUTE_UV, to, 6);
            Check(muslin_cloth_write_vertices(cloth, streams, 3, &desc));
        }
        mesh.SetVertexBufferData(vertices, 0, 0, (int)view.vertex_count * Stride / sizeof(float));
        if (view.topology_revision != topology)
        {
            var size = (UIntPtr)(indices.Length * sizeof(uint));
            fixed (uint* to = indices) Check(muslin_cloth_write_indices(cloth, to, size, 32, 0, 0));
            mesh.SetIndexBufferData(indices, 0, 0, (int)view.index_count);
            mesh.subMeshCount = 1;
            mesh.SetSubMesh(0, new SubMeshDescriptor(0, (int)view.index_count));
            topology = view.topology_revision;
        }
        mesh.RecalculateBounds();
    }

    MuslinStream Stream(uint attribute, float* start, int offset)
    {
        var size = (UIntPtr)((vertices.Length - offset) * sizeof(float));
        return muslin_stream(attribute, MUSLIN_FORMAT_F32, start + offset, Stride, size);
    }

    void OnDisable()
    {
        muslin_cloth_destroy(cloth);
        Destroy(mesh);
    }

    static MuslinVec3 From(Vector3 v)
    {
        return new MuslinVec3 { x = v.x, y = v.y, z = v.z };
    }

    static void Check(MuslinStatus status)
    {
        if (status != MuslinStatus.OK) throw new InvalidOperationException(Text(muslin_last_error()));
    }
}
