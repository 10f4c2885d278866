//! Label masks: what is written as images is read as outlines.

use crate::common::Files;
use motiform_tracks::{Cell, Format, Note, Options, Tracks, area, centroid, detect, read};
use std::io::Write;

const SIZE: [usize; 2] = [31, 23];

/// Labels of a frame: an ellipse that moves, a square, and a part of the ellipse's label apart from it.
fn labels(frame: usize) -> Vec<u32> {
    let at = |k: usize| {
        let [x, y] = [(k % SIZE[0]) as f64, (k / SIZE[0]) as f64];
        let [dx, dy] = [x - 10.0 - frame as f64, y - 11.0];
        match () {
            () if dx * dx / 49.0 + dy * dy / 25.0 < 1.0 => 7,
            () if (24.0..28.0).contains(&x) && (3.0..6.0).contains(&y) => 300,
            () if x < 2.0 && y < 2.0 => 7,
            () => 0,
        }
    };
    (0..SIZE[0] * SIZE[1]).map(at).collect()
}

#[derive(Clone, Copy, PartialEq)]
enum Packing {
    Plain,
    Lzw,
    Deflate,
    Bits,
}

/// A TIFF file of these images, 16 bits a pixel.
fn tiff(images: &[Vec<u32>], big: bool, packing: Packing, tiles: bool) -> Vec<u8> {
    let bytes = |value: usize, size: usize| {
        let all = value.to_le_bytes()[..size].to_vec();
        if big { all.into_iter().rev().collect::<Vec<u8>>() } else { all }
    };
    let mut file = if big { b"MM\0\x2a".to_vec() } else { b"II\x2a\0".to_vec() };
    let mut link = file.len();
    file.extend([0; 4]);
    let block = if tiles { [16, 16] } else { [SIZE[0], 7] };
    let across = SIZE[0].div_ceil(block[0]);
    for image in images {
        let blocks = across * SIZE[1].div_ceil(block[1]);
        let mut places = Vec::new();
        for k in 0..blocks {
            let [left, top] = [k % across * block[0], k / across * block[1]];
            let rows = if tiles { block[1] } else { block[1].min(SIZE[1] - top) };
            let pixel =
                |x: usize, y: usize| if x < SIZE[0] && y < SIZE[1] { image[y * SIZE[0] + x] } else { 0 };
            let data: Vec<u8> = (0..rows * block[0])
                .flat_map(|j| bytes(pixel(left + j % block[0], top + j / block[0]) as usize, 2))
                .collect();
            let packed = pack(&data, packing);
            places.push([file.len(), packed.len()]);
            file.extend(packed);
            file.resize(file.len().next_multiple_of(2), 0);
        }
        let lists = [0, 1].map(|k| {
            let at = file.len();
            places.iter().for_each(|place| file.extend(bytes(place[k], 4)));
            at
        });
        let compression = [1, 5, 8, 32773][packing as usize];
        let (offsets, sizes) = if tiles { (324, 325) } else { (273, 279) };
        let mut tags = vec![
            (256, 3, 1, SIZE[0]),
            (257, 3, 1, SIZE[1]),
            (258, 3, 1, 16),
            (259, 3, 1, compression),
            (offsets, 4, blocks, lists[0]),
            (sizes, 4, blocks, lists[1]),
        ];
        tags.extend(if tiles { vec![(322, 3, 1, 16), (323, 3, 1, 16)] } else { vec![(278, 3, 1, 7)] });
        let here = file.len();
        file[link..link + 4].copy_from_slice(&bytes(here, 4));
        file.extend(bytes(tags.len(), 2));
        for (tag, kind, count, value) in tags {
            file.extend([bytes(tag, 2), bytes(kind, 2), bytes(count, 4)].concat());
            let size = if kind == 3 { 2 } else { 4 };
            file.extend(bytes(value, size));
            file.extend(vec![0; 4 - size]);
        }
        link = file.len();
        file.extend([0; 4]);
    }
    file
}

fn pack(data: &[u8], packing: Packing) -> Vec<u8> {
    match packing {
        Packing::Plain => data.to_vec(),
        Packing::Deflate => {
            let mut writer = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::default());
            writer.write_all(data).expect("memory");
            writer.finish().expect("memory")
        }
        // a run of equal bytes, or one byte
        Packing::Bits => data
            .chunk_by(|a, b| a == b)
            .flat_map(|run| run.chunks(128))
            .flat_map(|run| [if run.len() > 1 { (257 - run.len()) as u8 } else { 0 }, run[0]])
            .collect(),
        Packing::Lzw => lzw(data),
    }
}

/// The encoder of the TIFF specification, section 13.
fn lzw(data: &[u8]) -> Vec<u8> {
    let mut table: std::collections::HashMap<Vec<u8>, usize> = std::collections::HashMap::new();
    let (mut out, mut bits, mut left) = (Vec::new(), 0_u64, 0_u32);
    let mut put = |code: usize, width: u32| {
        bits = bits << width | code as u64;
        left += width;
        while left >= 8 {
            left -= 8;
            out.push((bits >> left) as u8);
        }
    };
    let width = |entries: usize| (9..=12).find(|width| 258 + entries < 1 << width).unwrap_or(12);
    put(256, 9);
    let code = |table: &std::collections::HashMap<Vec<u8>, usize>, string: &[u8]| match string {
        [byte] => usize::from(*byte),
        longer => table[longer],
    };
    let mut string: Vec<u8> = Vec::new();
    for &byte in data {
        let longer = [string.as_slice(), &[byte]].concat();
        if longer.len() == 1 || table.contains_key(&longer) {
            string = longer;
            continue;
        }
        put(code(&table, &string), width(table.len()));
        table.insert(longer, 258 + table.len());
        string = vec![byte];
        if table.len() == 4094 - 258 {
            put(256, 12);
            table.clear();
        }
    }
    put(code(&table, &string), width(table.len()));
    put(257, width(table.len() + 1));
    put(0, 8);
    out
}

fn png(image: &[u32]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = ::png::Encoder::new(&mut bytes, SIZE[0] as u32, SIZE[1] as u32);
    encoder.set_color(::png::ColorType::Grayscale);
    encoder.set_depth(::png::BitDepth::Sixteen);
    let data: Vec<u8> = image.iter().flat_map(|&label| (label as u16).to_be_bytes()).collect();
    let mut writer = encoder.write_header().expect("an image");
    writer.write_image_data(&data).expect("an image");
    drop(writer);
    bytes
}

fn cells(tracks: &Tracks) -> Vec<&Cell> {
    assert_eq!(tracks.cells.iter().map(|cell| cell.name.as_str()).collect::<Vec<_>>(), ["7", "300"]);
    tracks.cells.iter().collect()
}

/// A folder with a table of tracks, a stack, and files one by one: the same outlines, in every packing.
#[test]
fn images_of_every_kind_have_the_same_outlines() {
    let images: Vec<Vec<u32>> = (0..4).map(labels).collect();
    let options = Options::default();
    let files = Files::new();
    let folder = files.path("01_RES");
    std::fs::create_dir(&folder).expect("a folder");
    for (k, image) in images.iter().enumerate() {
        std::fs::write(
            folder.join(format!("mask{:03}.tif", 2 * k)),
            tiff(std::slice::from_ref(image), false, Packing::Deflate, false),
        )
        .expect("a file");
    }
    std::fs::write(folder.join("res_track.txt"), "7 0 6 0\n300 0 6 7\n").expect("a file");
    let of_folder = read(&[&folder], &options).expect("masks");
    assert_eq!(detect(&folder, &options).expect("a folder"), Format::Masks);
    assert_eq!(of_folder.cells[0].frames.iter().map(|frame| frame.frame).collect::<Vec<_>>(), [0, 2, 4, 6]);
    assert!(of_folder.notes.contains(&Note::Becomes { cell: "7".to_owned(), into: vec!["300".to_owned()] }));
    assert!(of_folder.notes.contains(&Note::SeveralParts { cell: "7".to_owned(), frames: 4 }));
    assert_eq!((of_folder.y_down, of_folder.image.map(|image| image.size)), (Some(true), Some([31.0, 23.0])));
    let outlines = |tracks: &Tracks| -> Vec<Vec<[f64; 2]>> {
        cells(tracks).iter().flat_map(|cell| cell.frames.iter().map(|frame| frame.points.clone())).collect()
    };
    let expected = outlines(&of_folder);
    for big in [false, true] {
        for packing in [Packing::Plain, Packing::Lzw, Packing::Deflate, Packing::Bits] {
            for tiles in [false, true] {
                let stack = files.put("stack.tif", tiff(&images, big, packing, tiles));
                assert!(outlines(&read(&[stack], &options).expect("masks")) == expected);
            }
        }
    }
    let single: Vec<_> =
        images.iter().enumerate().map(|(k, image)| files.put(&format!("mask{k}.png"), png(image))).collect();
    assert!(outlines(&read(&single, &options).expect("masks")) == expected);
}

/// The contour at half level: a rectangle of pixels has its corners cut, the area is that of its pixels
/// without an eighth of one at each, and its middle is that of the pixels.
#[test]
fn contours_are_at_half_level() {
    let files = Files::new();
    let path = files.put("mask1.png", png(&labels(0)));
    let tracks = read(&[path], &Options { pixel_size: Some(0.5), ..Options::default() }).expect("masks");
    let square = &cells(&tracks)[1].frames[0].points;
    assert!((area(square).abs() - 0.25 * (12.0 - 0.5)).abs() < 1e-12);
    let middle = centroid(square);
    assert!((middle[0] - 0.5 * 26.0).abs() < 1e-12 && (middle[1] - 0.5 * 4.5).abs() < 1e-12, "{middle:?}");
    assert_eq!(square.len(), 14);
}

/// Pixels that touch at a corner alone are parts, of which the larger is kept.
#[test]
fn corners_do_not_join() {
    let at = |k: usize| {
        let [x, y] = [k % SIZE[0], k / SIZE[0]];
        let inside =
            (5..10).contains(&x) && (5..10).contains(&y) || (10..13).contains(&x) && (10..13).contains(&y);
        if inside {
            7
        } else if x == 0 {
            300
        } else {
            0
        }
    };
    let image: Vec<u32> = (0..SIZE[0] * SIZE[1]).map(at).collect();
    let files = Files::new();
    let tracks = read(&[files.put("a1.png", png(&image))], &Options::default()).expect("masks");
    assert!((area(&cells(&tracks)[0].frames[0].points).abs() - 24.5).abs() < 1e-12);
}

#[test]
fn what_is_no_mask_is_named() {
    let files = Files::new();
    let refusal = |name: &str, bytes: Vec<u8>| {
        read(&[files.put(name, bytes)], &Options::default()).expect_err("no mask").to_string()
    };
    let mut packed = tiff(&[labels(0)], false, Packing::Plain, false);
    let place = packed.windows(2).position(|tag| tag == [3, 1]).expect("the tag of the compression");
    packed[place + 8] = 7;
    assert!(refusal("a.tif", packed).contains("compression 7"));
    let whole = tiff(&[labels(0)], true, Packing::Lzw, false);
    assert!(refusal("b.tif", whole[..whole.len() / 2].to_vec()).contains("b.tif"));
    assert!(refusal("c.tif", b"II\x2a\0\x08\0\0\0\0\0\0\0\0\0".to_vec()).contains("no width"));
    let empty = files.path("empty");
    std::fs::create_dir(&empty).expect("a folder");
    assert!(
        read(&[empty], &Options::default())
            .expect_err("no image")
            .to_string()
            .contains(".tif, .tiff or .png")
    );
}
