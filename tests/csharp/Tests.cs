// The binding of C#: layouts, constants and functions against muslin.abi, the script of
// tests/c/script.c with the same bits, refusals, logs, structs by value, and views.
//
//     Tests.exe muslin.abi script.hash

using System;
using System.Collections.Generic;
using System.IO;
using System.Reflection;
using System.Runtime.InteropServices;
using Muslin;
using static Muslin.Native;

static unsafe class Tests
{
    static int failures;

    static int Main(string[] args)
    {
        string[] abi = File.ReadAllLines(args[0]);
        ulong golden = Convert.ToUInt64(File.ReadAllText(args[1]).Trim(), 16);
        Run("structs_have_the_layout_of_c", () => StructsHaveTheLayoutOfC(abi));
        Run("constants_have_the_values_of_c", () => ConstantsHaveTheValuesOfC(abi));
        Run("every_function_is_in_the_library", () => EveryFunctionIsInTheLibrary(abi));
        Run("the_script_ends_in_the_golden_hash", () => Equal(golden, HashOfScript()));
        Run("refusals_name_the_field_and_the_rule", RefusalsNameTheFieldAndTheRule);
        Run("structs_are_passed_by_value", StructsArePassedByValue);
        Run("a_view_is_the_memory_of_the_library", AViewIsTheMemoryOfTheLibrary);
        Run("vertices_are_written_into_an_array", VerticesAreWrittenIntoAnArray);
        Run("the_log_calls_a_delegate", TheLogCallsADelegate);
        Run("stats_have_the_time_of_each_stage", StatsHaveTheTimeOfEachStage);
        return failures;
    }

    static void StructsHaveTheLayoutOfC(string[] abi)
    {
        int count = 0;
        foreach (string line in abi)
        {
            // As in "  MuslinVec3.x: at 0, 4 bytes".
            string[] words = line.Trim().Split(new[] { ": at ", ", ", " bytes" }, StringSplitOptions.None);
            // A struct that may grow has no fixed size, nor have the fields behind it a fixed place.
            if (!line.StartsWith("  Muslin") || words.Length < 3) continue;
            string[] names = words[0].Split('.');
            Type type = typeof(Native).Assembly.GetType("Muslin." + names[0]);
            FieldInfo field = type?.GetField(names[1]);
            if (field == null) throw new Exception(words[0] + " is missing");
            Equal(words[0] + " at " + words[1], words[0] + " at " + Marshal.OffsetOf(type, names[1]));
            object[] arrays = field.GetCustomAttributes(typeof(System.Runtime.CompilerServices.FixedBufferAttribute), false);
            int length = arrays.Length == 0 ? 1 : ((System.Runtime.CompilerServices.FixedBufferAttribute)arrays[0]).Length;
            int size = field.FieldType.IsPointer ? IntPtr.Size : arrays.Length == 0 ? Marshal.SizeOf(field.FieldType) : 4 * length;
            Equal(words[0] + " of " + words[2], words[0] + " of " + size);
            count++;
        }
        True(count > 150, "only " + count + " fields were compared");
    }

    static void ConstantsHaveTheValuesOfC(string[] abi)
    {
        int count = 0;
        foreach (string line in abi)
        {
            string[] words = line.Split(new[] { " = " }, StringSplitOptions.None);
            if (!line.StartsWith("MUSLIN_") || words.Length != 2) continue;
            const string Status = "MUSLIN_STATUS_";
            object value = words[0].StartsWith(Status)
                ? (uint)(int)Enum.Parse(typeof(MuslinStatus), words[0].Substring(Status.Length))
                : typeof(Native).GetField(words[0])?.GetRawConstantValue();
            Equal(line, words[0] + " = " + value);
            count++;
        }
        True(count > 60, "only " + count + " constants were compared");
    }

    static void EveryFunctionIsInTheLibrary(string[] abi)
    {
        int count = 0;
        foreach (string line in abi)
        {
            int end = line.IndexOf('(');
            int start = line.IndexOf("muslin_");
            if (end < 0 || start < 0 || start > end) continue;
            string name = line.Substring(start, end - start);
            MethodInfo method = typeof(Native).GetMethod(name);
            if (method == null) throw new Exception(name + " is missing");
            Marshal.Prelink(method); // throws if the library does not export it
            count++;
        }
        True(count > 80, "only " + count + " functions were looked up");
    }

    /// As tests/c/script.c.
    static ulong HashOfScript()
    {
        MuslinGridDesc desc;
        muslin_grid_desc_init(&desc);
        desc.settings.tearing = 1;
        desc.material.tear_stretch = 1.5f;
        MuslinCloth cloth;
        Done(muslin_cloth_create_grid(&desc, &cloth));
        MuslinWind wind;
        muslin_wind_init(&wind);
        wind.velocity = Vec3(0.25f, 0, 1);
        wind.gust = 0.5f;
        wind.wander = 0.25f;
        wind.turbulence = 0.25f;
        wind.seed = 7;
        Done(muslin_cloth_set_wind(cloth, &wind));
        MuslinColliderDesc floor;
        MuslinCollider collider;
        muslin_collider_desc_init(&floor);
        floor.position.y = -2.5f;
        Done(muslin_cloth_add_collider(cloth, &floor, &collider));
        Done(muslin_cloth_step(cloth, 120));

        MuslinGrab grab;
        MuslinVec3 at;
        Done(muslin_cloth_grab_ray(cloth, Vec3(1, -1, 5), Vec3(0, 0, -1), 0.1f, &grab, &at));
        for (int i = 1; i <= 120; i++)
        {
            MuslinVec3 target = at;
            target.x += 0.015625f * i;
            target.z += 0.03125f * i;
            Done(muslin_cloth_move_grab(cloth, grab, target));
            Done(muslin_cloth_step(cloth, 1));
        }
        Done(muslin_cloth_tear_edge(cloth, 820, 860));
        Done(muslin_cloth_release(cloth, grab));
        Done(muslin_cloth_step(cloth, 180));
        uint edges, ticks;
        MuslinVec3 from = Vec3(-1, -0.59375f, -9), to = Vec3(3, -0.78125f, -9);
        Done(muslin_cloth_cut(cloth, from, to, Vec3(0, 0, 18), &edges));
        True(edges > 40, "the cut opened only " + edges + " edges");
        Done(muslin_cloth_step(cloth, 30));

        Done(muslin_cloth_unpin_all(cloth));
        Done(muslin_cloth_step(cloth, 120));
        MuslinVec3 corner = Vec3(0, 0, 0.5f);
        Done(muslin_cloth_pin(cloth, 0, &corner));
        Done(muslin_cloth_step(cloth, 59));
        Done(muslin_cloth_advance(cloth, 1.0f / 60.0f, &ticks));
        Equal(1u, ticks);
        ulong hash;
        Done(muslin_cloth_state_hash(cloth, &hash));
        Done(muslin_cloth_destroy(cloth));
        return hash;
    }

    static void RefusalsNameTheFieldAndTheRule()
    {
        MuslinGridDesc desc;
        muslin_grid_desc_init(&desc);
        desc.columns = 1;
        MuslinCloth cloth = new MuslinCloth { id = 99 };
        Equal(MuslinStatus.BAD_VALUE, muslin_cloth_create_grid(&desc, &cloth));
        True(Text(muslin_last_error()).Contains("columns"), Text(muslin_last_error()));
        Equal(99ul, cloth.id);
        Equal(MuslinStatus.BAD_HANDLE, muslin_cloth_step(cloth, 1));
        Equal(MuslinStatus.BAD_VALUE, muslin_cloth_create_grid(null, &cloth));
    }

    static void StructsArePassedByValue()
    {
        MuslinCloth cloth = Grid();
        MuslinColliderDesc box;
        MuslinCollider collider;
        muslin_collider_desc_init(&box);
        box.shape = MUSLIN_SHAPE_BOX;
        Done(muslin_cloth_add_collider(cloth, &box, &collider));
        MuslinQuat half = new MuslinQuat { x = 0, y = 1, z = 0, w = 0 };
        Done(muslin_cloth_move_collider(cloth, collider, Vec3(3, 4, 5), half));
        Done(muslin_cloth_step(cloth, 1));
        MuslinVec3 position;
        MuslinQuat rotation;
        Done(muslin_cloth_get_collider_pose(cloth, collider, &position, &rotation));
        Equal("3 4 5", position.x + " " + position.y + " " + position.z);
        Equal("0 1 0 0", rotation.x + " " + Math.Abs(rotation.y) + " " + rotation.z + " " + Math.Abs(rotation.w));
        Done(muslin_cloth_destroy(cloth));
    }

    static void AViewIsTheMemoryOfTheLibrary()
    {
        MuslinCloth cloth = Grid();
        MuslinView view;
        muslin_view_init(&view);
        Done(muslin_cloth_view(cloth, &view));
        Equal(1600u, view.vertex_count);
        Equal(-1.95f, view.positions[3 * 1599 + 1]);
        Done(muslin_cloth_set_position(cloth, 1599, Vec3(7, 8, 9)));
        Done(muslin_cloth_view(cloth, &view));
        float* last = view.positions + 3 * 1599;
        Equal("7 8 9", last[0] + " " + last[1] + " " + last[2]);
        Done(muslin_cloth_destroy(cloth));
    }

    static void VerticesAreWrittenIntoAnArray()
    {
        MuslinCloth cloth = Grid();
        MuslinWriteDesc desc;
        muslin_write_desc_init(&desc);
        desc.transform[3] = 10; // moves by 10 m along x
        var vertices = new float[6 * 1600];
        fixed (float* to = vertices)
        {
            MuslinStream* streams = stackalloc MuslinStream[2];
            var size = (UIntPtr)(vertices.Length * sizeof(float));
            streams[0] = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, to, 24, size);
            streams[1] = muslin_stream(MUSLIN_ATTRIBUTE_NORMAL, MUSLIN_FORMAT_F32, to + 3, 24, (UIntPtr)((ulong)size - 12));
            Done(muslin_cloth_write_vertices(cloth, streams, 2, &desc));
            Equal(MuslinStatus.BUFFER_TOO_SMALL, TryWrite(cloth, to));
        }
        Equal("10 0 0", vertices[0] + " " + vertices[1] + " " + vertices[2]);
        Equal("0 0 1", vertices[3] + " " + vertices[4] + " " + vertices[5]);
        Done(muslin_cloth_destroy(cloth));
    }

    static MuslinStatus TryWrite(MuslinCloth cloth, float* to)
    {
        MuslinStream small = muslin_stream(MUSLIN_ATTRIBUTE_POSITION, MUSLIN_FORMAT_F32, to, 12, (UIntPtr)12);
        MuslinWriteDesc desc;
        muslin_write_desc_init(&desc);
        return muslin_cloth_write_vertices(cloth, &small, 1, &desc);
    }

    static void TheLogCallsADelegate()
    {
        var messages = new List<string>();
        MuslinLogFn log = (level, message, user) => messages.Add(level + " " + (ulong)user + " " + Text(message));
        Done(muslin_set_log(log, MUSLIN_LOG_WARN, (void*)7));
        muslin_cloth_step(new MuslinCloth(), 1);
        Done(muslin_set_log(null, 0, null));
        muslin_cloth_step(new MuslinCloth(), 1);
        GC.KeepAlive(log);
        Equal(1, messages.Count);
        True(messages[0].StartsWith(MUSLIN_LOG_WARN + " 7 "), messages[0]);
    }

    static void StatsHaveTheTimeOfEachStage()
    {
        MuslinCloth cloth = Grid();
        MuslinStats stats;
        muslin_stats_init(&stats);
        Done(muslin_cloth_get_stats(cloth, &stats));
        Done(muslin_cloth_step(cloth, 10));
        Done(muslin_cloth_get_stats(cloth, &stats));
        Equal(1600u, stats.particles);
        double sum = 0;
        for (uint i = 0; i < stats.stage_count; i++) sum += stats.seconds[i];
        True(sum > 0 && sum < 10, "the stages took " + sum + " s");
        Done(muslin_cloth_destroy(cloth));
    }

    static MuslinCloth Grid()
    {
        MuslinGridDesc desc;
        MuslinCloth cloth;
        muslin_grid_desc_init(&desc);
        Done(muslin_cloth_create_grid(&desc, &cloth));
        return cloth;
    }

    static MuslinVec3 Vec3(float x, float y, float z)
    {
        return new MuslinVec3 { x = x, y = y, z = z };
    }

    static void Done(MuslinStatus status)
    {
        if (status != MuslinStatus.OK) throw new Exception(status + ": " + Text(muslin_last_error()));
    }

    static void Equal<T>(T wanted, T found)
    {
        if (!wanted.Equals(found)) throw new Exception("expected " + wanted + ", found " + found);
    }

    static void True(bool claim, string otherwise)
    {
        if (!claim) throw new Exception(otherwise);
    }

    static void Run(string name, Action test)
    {
        try
        {
            test();
            Console.WriteLine("  ok " + name);
        }
        catch (Exception error)
        {
            failures++;
            Console.WriteLine("FAIL " + name + ": " + error.Message);
        }
    }
}
