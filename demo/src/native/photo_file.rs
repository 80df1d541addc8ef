//! File of a photo.
//!
//! Method: PNG with the first free number in the name, such as `muslin-glass-1.png`.
//!
//! Reads a [`Photo`]; writes a file.
//!
//! Invariant: no file is replaced.

use std::fs::File;
use std::io::{BufWriter, ErrorKind};
use std::path::{Path, PathBuf};

use crate::app::photo::Photo;

/// Saves a photo of a scene in a folder, and returns the path.
///
/// # Errors
/// The error of the file system.
pub fn save(folder: &Path, scene: &str, photo: &Photo) -> Result<PathBuf, png::EncodingError> {
    for number in 1_u32.. {
        let path = folder.join(format!("muslin-{scene}-{number}.png"));
        match File::create_new(&path) {
            Ok(file) => return write(file, photo).map(|()| path),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error.into()),
        }
    }
    Err(std::io::Error::from(ErrorKind::AlreadyExists).into())
}

fn write(file: File, photo: &Photo) -> Result<(), png::EncodingError> {
    let [width, height] = photo.size;
    let mut encoder = png::Encoder::new(BufWriter::new(file), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let rgb: Vec<u8> =
        photo.pixels.iter().flat_map(|pixel| [pixel[0], pixel[1], pixel[2]]).collect();
    encoder.write_header()?.write_image_data(&rgb)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_photo_gets_a_file_of_its_own() {
        let folder = std::env::temp_dir().join(format!("muslin-photos-{}", std::process::id()));
        std::fs::create_dir_all(&folder).unwrap();
        let photo = Photo { size: [2, 1], pixels: vec![[1, 2, 3, 255], [4, 5, 6, 255]] };
        for name in ["muslin-flag-1.png", "muslin-flag-2.png"] {
            let path = save(&folder, "flag", &photo).unwrap();
            assert_eq!(path, folder.join(name));
            let file = std::io::BufReader::new(File::open(&path).unwrap());
            let mut reader = png::Decoder::new(file).read_info().unwrap();
            let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
            reader.next_frame(&mut rgb).unwrap();
            assert_eq!(rgb, [1, 2, 3, 4, 5, 6]);
        }
        std::fs::remove_dir_all(&folder).unwrap();
        assert!(save(&folder, "flag", &photo).is_err());
    }
}
