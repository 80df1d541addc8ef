#!/usr/bin/env python3
"""Drops a cloth over a ball and draws it. Reads muslin.h with ctypes; needs no other package.

    python3 bindings/c/examples/viewer.py include/muslin.h target/release/libmuslin.so picture.png [include/muslin.abi]

With muslin.abi it also compares numbers, offsets and sizes with those of a C compiler."""
import ctypes
import math
import re
import struct
import sys
import zlib

SCALARS = {"float": ctypes.c_float, "uint8_t": ctypes.c_uint8, "uint32_t": ctypes.c_uint32, "void": None,
           "uint64_t": ctypes.c_uint64, "size_t": ctypes.c_size_t, "MuslinStatus": ctypes.c_uint32}


class Muslin:
    """The structs, constants and functions of the header, as attributes by name."""

    def __init__(self, header, library):
        text = re.sub(r"/\*.*?\*/|//[^\n]*", "", open(header, encoding="utf-8").read(), flags=re.S)
        text = text.split("static inline")[0]
        self.numbers, self.types = {"UINT32_MAX": 0xFFFFFFFF}, dict(SCALARS)
        for name, value in re.findall(r"(MUSLIN_\w+)(?: =)? (\w+)", text):
            self.numbers[name] = self.numbers[value] if value in self.numbers else int(value)
        for name, body in re.findall(r"typedef struct (\w+) \{(.*?)\} \w+;", text, re.S):
            fields = [self.field(*field) for field in re.findall(r"([\w ]+?[ *]+)(\w+)(?:\[(\w+)\])?;", body)]
            self.types[name] = type(name, (ctypes.Structure,), {"_fields_": fields})
        functions = re.findall(r"^([\w ]+?[ *]+)(muslin_\w+)\(([^)]*)\);", text, re.S | re.M)
        for result, name, given in functions:
            function = getattr(ctypes.CDLL(library), name)
            function.restype = ctypes.c_char_p if "*" in result else self.types[result.strip()]
            function.argtypes = [self.parameter(one) for one in given.split(",") if one.strip() != "void"]
            setattr(self, name, function)

    def parameter(self, words):
        return ctypes.c_void_p if "*" in words or "LogFn" in words else self.types[words.split()[0]]

    def field(self, words, name, count):
        of = self.types[words.replace("const", "").strip(" *")]
        if "*" in words:
            return name, ctypes.POINTER(of) if of else ctypes.c_void_p
        return name, of * (self.numbers.get(count) or int(count)) if count else of

    def call(self, name, *given):
        """Calls a function; raises ValueError with the library's message if it fails."""
        if getattr(self, name)(*given) != self.numbers["MUSLIN_STATUS_OK"]:
            raise ValueError(f"{name}: {self.muslin_last_error().decode()}")

    def begin(self, name, init=None, *parts):
        """A struct with its size set, and with its defaults if `init` is given."""
        it = self.types[name](ctypes.sizeof(self.types[name]))
        if init:
            self.call(init, ctypes.byref(it), *[ctypes.sizeof(self.types[part]) for part in (name, *parts)])
        return it

    def compare(self, abi):
        """Asserts that numbers, offsets and sizes equal those of muslin.abi; returns how many there are."""
        lines = open(abi, encoding="utf-8").read()
        for name, value in (numbers := re.findall(r"^(MUSLIN_\w+) = (\d+)$", lines, re.M)):
            assert self.numbers[name] == int(value), f"{name} is {self.numbers[name]}, not {value}"
        for of, name, *there in (fields := re.findall(r"^  (\w+)\.(\w+): at (\d+), (\d+) bytes", lines, re.M)):
            field = getattr(self.types[of], name)
            assert [field.offset, field.size] == [int(one) for one in there], f"{of}.{name} is not at {there}"
        return len(numbers) + len(fields)


def drop(muslin):
    """Simulates a sheet that falls over a ball; returns its view."""
    desc = muslin.begin("MuslinGridDesc", "muslin_grid_desc_init_sized", "MuslinMaterial", "MuslinSettings")
    desc.columns, desc.rows, desc.spacing, desc.pin_mode = 56, 56, 0.036, muslin.numbers["MUSLIN_PIN_NONE"]
    desc.origin, desc.down = (-1.0, 1.0, -0.9), (0, 0, 1)
    desc.settings.self_collision = muslin.numbers["MUSLIN_SELF_COLLISION_SURFACE"]
    cloth, made = muslin.types["MuslinCloth"](), muslin.types["MuslinCollider"]()
    muslin.call("muslin_cloth_create_grid", ctypes.byref(desc), ctypes.byref(cloth))
    ground = muslin.begin("MuslinColliderDesc", "muslin_collider_desc_init_sized")
    muslin.call("muslin_cloth_add_collider", cloth, ctypes.byref(ground), ctypes.byref(made))
    ground.shape, ground.radius, ground.position = muslin.numbers["MUSLIN_SHAPE_SPHERE"], 0.45, (0, 0.45, 0)
    muslin.call("muslin_cloth_add_collider", cloth, ctypes.byref(ground), ctypes.byref(made))
    muslin.call("muslin_cloth_step", cloth, 150)
    view = muslin.begin("MuslinView")
    muslin.call("muslin_cloth_view", cloth, ctypes.byref(view))
    return view  # borrowed from the cloth, which is not changed any more


def draw(view, width=1120, height=840):
    """Renders at twice the size; returns rows of colours."""
    paper = [[(205 + y * 24 // height, 208 + y * 16 // height, 212 + y * 6 // height)] * width for y in range(height)]
    depth = [[math.inf] * width for _ in range(height)]
    eye, tilt, sun = (0, 1.7, 3.3), 0.37, (-0.46, 0.76, 0.46)

    def seen(p):
        y, z = p[1] - eye[1], p[2] - eye[2]
        away = -math.sin(tilt) * y - math.cos(tilt) * z
        zoom = 1.75 * height / away
        return width / 2 + (p[0] - 0.05) * zoom, height / 2 - (math.cos(tilt) * y - math.sin(tilt) * z) * zoom, away

    def fill(a, b, c, colour):
        area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        for y in range(max(0, math.ceil(min(a[1], b[1], c[1]))), min(height, math.ceil(max(a[1], b[1], c[1])))):
            row, at = depth[y], paper[y]
            for x in range(max(0, math.ceil(min(a[0], b[0], c[0]))), min(width, math.ceil(max(a[0], b[0], c[0])))):
                v = ((x - a[0]) * (c[1] - a[1]) - (y - a[1]) * (c[0] - a[0])) / area if area else -1
                w = ((b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0])) / area if area else -1
                if v >= 0 and w >= 0 and v + w <= 1 and (z := a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])) < row[x]:
                    row[x], at[x] = z, colour(v, w)

    places = [view.positions[3 * i:3 * i + 3] for i in range(view.vertex_count)]
    shades = [max(-0.35, sum(view.normals[3 * i + k] * sun[k] for k in range(3))) for i in range(view.vertex_count)]
    corners = [view.indices[i:i + 3] for i in range(0, view.index_count, 3)]
    floor = [seen((p[0] - sun[0] * p[1] / sun[1], 0, p[2] - sun[2] * p[1] / sun[1])) for p in places]
    for a, b, c in corners:
        fill(floor[a], floor[b], floor[c], lambda v, w: (164, 161, 158))
    points = [seen(p) for p in places]
    for a, b, c in corners:
        p, q, r = points[a], points[b], points[c]
        side = 1 if (q[0] - p[0]) * (r[1] - p[1]) < (q[1] - p[1]) * (r[0] - p[0]) else -1
        uvs, lit = [view.uvs[2 * i:2 * i + 2] for i in (a, b, c)], [0.42 + 0.6 * max(0, side * shades[i]) for i in (a, b, c)]

        def colour(v, w):
            mix = lambda one, two, three: one + v * (two - one) + w * (three - one)
            stripes = (mix(*[uv[0] for uv in uvs]) * 8 % 1 < 0.5) + (mix(*[uv[1] for uv in uvs]) * 8 % 1 < 0.5)
            return tuple(int(min(255, tone * mix(*lit))) for tone in ((44, 84, 138), (120, 154, 190), (236, 233, 222))[stripes])
        fill(p, q, r, colour)
    return paper


def save(path, rows):
    """Writes a PNG of half the size; each pixel is the mean of four."""
    half = b""
    for above, below in zip(rows[::2], rows[1::2]):
        fours = zip(above[::2], above[1::2], below[::2], below[1::2])
        half += b"\0" + bytes(sum(channel) // 4 for four in fours for channel in zip(*four))
    size = struct.pack(">IIBBBBB", len(rows[0]) // 2, len(rows) // 2, 8, 2, 0, 0, 0)
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", size), (b"IDAT", zlib.compress(half)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))


if __name__ == "__main__":
    library = Muslin(*sys.argv[1:3])
    print(f"Muslin {library.muslin_version_string().decode()}:", len(library.types), "types")
    if len(sys.argv) > 4:
        print(library.compare(sys.argv[4]), "numbers, offsets and sizes as in", sys.argv[4])
    save(sys.argv[3], draw(drop(library)))
