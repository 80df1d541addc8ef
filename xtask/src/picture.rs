//! Checks that a picture is not blank.

use std::collections::HashSet;
use std::fs::File;
use std::io::BufReader;
use std::path::Path;

use png::{Decoder, Transformations};

use crate::failure::{During, Failure, Result};

/// The least number of colours in the middle of a picture, at 32 shades a channel.
const MIN_COLOURS: usize = 24;
/// The least difference between the brightest and darkest pixel in the middle, of 255.
const MIN_RANGE: u8 = 60;

/// Fails if the middle of a PNG is blank or nearly so.
pub fn check(file: &Path) -> Result {
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    let (size, rgb) = read(file).during(|| format!("reading the picture {name}"))?;
    let (colours, range) = measure(size, &rgb);
    if colours < MIN_COLOURS || range < MIN_RANGE {
        return Err(Failure::new(format!(
            "the picture {name} is blank: {colours} colours, a range of {range}"
        )));
    }
    println!(
        "the picture {name}: {} x {}, {colours} colours, a range of {range}",
        size[0], size[1]
    );
    Ok(())
}

pub type Pixels = ([usize; 2], Vec<[u8; 3]>);

/// Reads a PNG: width and height, and red, green and blue of each pixel from the top row.
pub fn read(file: &Path) -> Result<Pixels> {
    let why = || String::from("PNG");
    let mut decoder = Decoder::new(BufReader::new(File::open(file).during(why)?));
    decoder.set_transformations(Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().during(why)?;
    let bytes =
        reader.output_buffer_size().ok_or_else(|| Failure::new("the picture is too large"))?;
    let mut pixels = vec![0; bytes];
    let info = reader.next_frame(&mut pixels).during(why)?;
    let samples = info.color_type.samples();
    let colour = |p: &[u8]| if samples < 3 { [p[0]; 3] } else { [p[0], p[1], p[2]] };
    let rgb = pixels[..info.buffer_size()].chunks_exact(samples).map(colour).collect();
    Ok(([info.width as usize, info.height as usize], rgb))
}

/// The number of colours in the middle of a picture, and the range of its green channel.
fn measure([width, height]: [usize; 2], rgb: &[[u8; 3]]) -> (usize, u8) {
    let (mut colours, mut least, mut most) = (HashSet::new(), u8::MAX, 0);
    for row in height / 5..height * 4 / 5 {
        for pixel in &rgb[row * width + width / 4..row * width + width * 3 / 4] {
            colours.insert(pixel.map(|channel| channel >> 3));
            least = least.min(pixel[1]);
            most = most.max(pixel[1]);
        }
    }
    (colours.len(), most.saturating_sub(least))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_colour_is_blank_and_a_gradient_is_not() {
        assert_eq!(measure([64, 64], &[[9, 9, 9]; 64 * 64]), (1, 0));
        let gradient: Vec<_> = (0..64 * 64).map(|i| [i as u8, (i / 16) as u8, 40]).collect();
        let (colours, range) = measure([64, 64], &gradient);
        assert!(colours >= MIN_COLOURS && range >= MIN_RANGE, "{colours} colours, range {range}");
    }
}
