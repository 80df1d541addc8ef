//! Reads the triangles of OBJ and glTF files: all their objects as one mesh.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use gltf::buffer::Source;
use gltf::mesh::Mode;
use muslin::MeshDesc;
use muslin::glam::{Mat4, Vec2, Vec3};
use std::path::Path;

/// Reads a file by its extension.
pub fn read(path: &Path) -> Result<MeshDesc, String> {
    let extension = path.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    let desc = match extension.as_str() {
        "obj" => read_obj(path)?,
        "gltf" | "glb" => read_gltf(path)?,
        _ => return Err("the name must end in .obj, .gltf or .glb".into()),
    };
    if desc.indices.is_empty() { Err("the file has no triangles".into()) } else { Ok(desc) }
}

/// Appends a mesh.
fn push(desc: &mut MeshDesc, positions: Vec<Vec3>, uvs: Vec<Vec2>, indices: Vec<u32>) {
    let first = desc.positions.len() as u32;
    // Texture coordinates are for all vertices or for none.
    let has_uvs = uvs.len() == positions.len() && desc.uvs.len() == desc.positions.len();
    desc.positions.extend(positions);
    desc.uvs.extend(uvs);
    if !has_uvs {
        desc.uvs.clear();
    }
    desc.indices.extend(indices.into_iter().map(|index| first + index));
}

fn read_obj(path: &Path) -> Result<MeshDesc, String> {
    let options = tobj::LoadOptions { triangulate: true, single_index: true, ..Default::default() };
    // Materials are not read.
    let no_materials = |_: &Path| Ok(Default::default());
    let file = std::fs::File::open(path).map_err(|error| error.to_string())?;
    let (models, _) =
        tobj::load_obj_buf(&mut std::io::BufReader::new(file), &options, no_materials)
            .map_err(|error| error.to_string())?;
    let mut desc = MeshDesc::default();
    for tobj::Model { mesh, .. } in models {
        let positions = mesh.positions.as_chunks::<3>().0.iter().copied().map(Vec3::from);
        let uvs = mesh.texcoords.as_chunks::<2>().0.iter().copied().map(Vec2::from);
        push(&mut desc, positions.collect(), uvs.collect(), mesh.indices);
    }
    Ok(desc)
}

fn read_gltf(path: &Path) -> Result<MeshDesc, String> {
    let gltf = gltf::Gltf::open(path).map_err(|error| error.to_string())?;
    let buffers: Vec<Vec<u8>> = gltf
        .buffers()
        .map(|buffer| match buffer.source() {
            Source::Bin => gltf.blob.clone().ok_or_else(|| "the binary part is missing".into()),
            Source::Uri(uri) => load_uri(path, uri),
        })
        .collect::<Result<_, String>>()?;
    let mut desc = MeshDesc::default();
    let scene = gltf.default_scene().or_else(|| gltf.scenes().next()).ok_or("there is no scene")?;
    let mut stack: Vec<_> = scene.nodes().map(|node| (Mat4::IDENTITY, node)).collect();
    while let Some((to_parent, node)) = stack.pop() {
        let to_world = to_parent * Mat4::from_cols_array_2d(&node.transform().matrix());
        stack.extend(node.children().map(|child| (to_world, child)));
        let primitives =
            node.mesh().into_iter().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
        for primitive in primitives.filter(|primitive| primitive.mode() == Mode::Triangles) {
            let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(Vec::as_slice));
            let positions = reader.read_positions().ok_or("positions are missing")?;
            let positions: Vec<Vec3> =
                positions.map(|x| to_world.transform_point3(Vec3::from(x))).collect();
            let uvs = reader.read_tex_coords(0);
            let uvs = uvs.map_or_else(Vec::new, |uvs| uvs.into_f32().map(Vec2::from).collect());
            let indices = match reader.read_indices() {
                Some(indices) => indices.into_u32().collect(),
                None => (0..positions.len() as u32).collect(),
            };
            push(&mut desc, positions, uvs, indices);
        }
    }
    Ok(desc)
}

/// The bytes of a data URI or of a file beside the glTF file.
fn load_uri(path: &Path, uri: &str) -> Result<Vec<u8>, String> {
    match uri.strip_prefix("data:") {
        Some(data) => {
            let (_, text) = data.split_once("base64,").ok_or("a data URI must be base64")?;
            BASE64_STANDARD.decode(text).map_err(|error| error.to_string())
        }
        None => std::fs::read(path.with_file_name(uri)).map_err(|error| format!("{uri}: {error}")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Writes a file into the folder of temporary files, reads it, and removes it.
    fn read_text(name: &str, text: &str) -> Result<MeshDesc, String> {
        let path = std::env::temp_dir().join(format!("muslin-{}-{name}", std::process::id()));
        std::fs::write(&path, text).unwrap();
        let desc = read(&path);
        std::fs::remove_file(&path).unwrap();
        desc
    }

    #[test]
    fn an_obj_file_gives_triangles_with_the_texture_coordinates_of_their_corners() {
        let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvt 5 5\n\
                    f 1/1 2/2 3/3 4/4\nf 1/5 4/4 3/3\n";
        let desc = read_text("quad.obj", text).unwrap();
        assert_eq!((desc.indices.len(), desc.positions.len(), desc.uvs.len()), (9, 5, 5));
        let corner = |k: usize| desc.indices[k] as usize;
        assert_eq!(desc.positions[corner(6)], desc.positions[corner(0)]);
        assert_eq!((desc.uvs[corner(6)], desc.uvs[corner(0)]), (Vec2::splat(5.0), Vec2::ZERO));
    }

    #[test]
    fn a_gltf_file_is_placed_by_its_nodes() {
        let numbers = [0.0_f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
        let bytes: Vec<u8> = numbers.iter().flat_map(|x| x.to_le_bytes()).collect();
        let data = BASE64_STANDARD.encode(&bytes);
        let text = format!(
            r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
            "nodes":[{{"translation":[0,0,2],"children":[1]}},{{"mesh":0,"scale":[3,3,3]}}],
            "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
            "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
            "min":[0,0,0],"max":[1,1,0]}}],
            "bufferViews":[{{"buffer":0,"byteLength":36}}],
            "buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,{data}"}}]}}"#
        );
        let desc = read_text("triangle.gltf", &text).unwrap();
        assert_eq!(desc.positions[1..], [Vec3::new(3.0, 0.0, 2.0), Vec3::new(0.0, 3.0, 2.0)]);
        assert_eq!((desc.indices, desc.uvs.len()), (vec![0, 1, 2], 0));
    }

    #[test]
    fn other_files_and_files_without_triangles_are_refused_in_words() {
        let why = |name, text| read_text(name, text).unwrap_err();
        assert_eq!(why("mesh.fbx", ""), "the name must end in .obj, .gltf or .glb");
        assert_eq!(why("points.obj", "v 0 0 0\n"), "the file has no triangles");
    }
}
