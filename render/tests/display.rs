//! `--display`: the pictures that a viewer receives, decoded as the protocol of tev states them.

use crate::bench;

use bench::{Bench, TEXTURED_WALL, checks, ending};
use std::collections::BTreeMap;
use std::io::{self, Read};
use std::net::{TcpListener, TcpStream};
use std::thread::{JoinHandle, spawn};

/// A picture in the viewer: its size, and the values of each channel row by row.
#[derive(Debug, Default)]
struct Shown {
    size: [usize; 2],
    channels: BTreeMap<String, Vec<f32>>,
    updates: usize,
}

/// Takes values from the front of a packet.
struct Packet<'p>(&'p [u8]);

impl Packet<'_> {
    fn take<const N: usize>(&mut self) -> [u8; N] {
        let (own, rest) = self.0.split_at(N);
        self.0 = rest;
        own.try_into().unwrap()
    }

    fn int(&mut self) -> usize {
        usize::try_from(i32::from_le_bytes(self.take())).unwrap()
    }

    fn long(&mut self) -> usize {
        usize::try_from(i64::from_le_bytes(self.take())).unwrap()
    }

    fn text(&mut self) -> String {
        let end = self.0.iter().position(|byte| *byte == 0).unwrap();
        let text = String::from_utf8(self.0[..end].to_vec()).unwrap();
        self.0 = &self.0[end + 1..];
        text
    }
}

/// A viewer that shows nothing: it keeps the pictures that it receives on one connection.
fn viewer() -> (String, JoinHandle<BTreeMap<String, Shown>>) {
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    (address, spawn(move || received(&listener.accept().unwrap().0)))
}

fn received(mut stream: &TcpStream) -> BTreeMap<String, Shown> {
    let mut pictures = BTreeMap::new();
    loop {
        let mut length = [0; 4];
        match stream.read_exact(&mut length) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => return pictures,
            read => read.unwrap(),
        }
        let mut bytes = vec![0; u32::from_le_bytes(length) as usize - 4];
        stream.read_exact(&mut bytes).unwrap();
        let mut packet = Packet(&bytes);
        let [kind] = packet.take();
        match kind {
            2_u8 => drop(pictures.remove(&packet.text())),
            4 => {
                packet.take::<1>();
                let name = packet.text();
                let size = [packet.int(), packet.int()];
                let names: Vec<String> = (0..packet.int()).map(|_| packet.text()).collect();
                let black = vec![0.0; size[0] * size[1]];
                let channels = names.into_iter().map(|name| (name, black.clone())).collect();
                assert!(pictures.insert(name, Shown { size, channels, updates: 0 }).is_none());
            }
            6 => update(&mut pictures, &mut packet),
            other => panic!("a packet of kind {other}"),
        }
        assert!(packet.0.is_empty(), "{} bytes too many", packet.0.len());
    }
}

fn update(pictures: &mut BTreeMap<String, Shown>, packet: &mut Packet<'_>) {
    packet.take::<1>();
    let shown = pictures.get_mut(&packet.text()).expect("the picture was created");
    shown.updates += 1;
    let names: Vec<String> = (0..packet.int()).map(|_| packet.text()).collect();
    let [x, y, width, height] = [0; 4].map(|_| packet.int());
    let offsets: Vec<usize> = names.iter().map(|_| packet.long()).collect();
    let strides: Vec<usize> = names.iter().map(|_| packet.long()).collect();
    let mut data = Vec::new();
    while !packet.0.is_empty() {
        data.push(f32::from_le_bytes(packet.take()));
    }
    assert!(x + width <= shown.size[0] && y + height <= shown.size[1]);
    for ((name, offset), stride) in names.iter().zip(offsets).zip(strides) {
        let values = shown.channels.get_mut(name).expect("the channel was created");
        for k in 0..width * height {
            let place = (y + k / width) * shown.size[0] + x + k % width;
            values[place] = data[offset + k * stride];
        }
    }
}

fn wall() -> Bench {
    let bench = Bench::with_scene(TEXTURED_WALL);
    bench.write("checks.png", checks());
    bench
}

#[test]
fn a_viewer_receives_the_numbers_of_the_exr() {
    for flags in [
        &["--size", "150x90"][..],
        &["--size", "150x90", "--error", "0.02"],
        &["--size", "150x90", "--crop", "20,30,100x50", "--sampling", "thesis"],
        &["--size", "90x70", "--alpha"],
    ] {
        let bench = wall();
        // The wall covers a part of the picture only.
        let scene = TEXTURED_WALL.replace("\"edge_u\": [4, 0, 0]", "\"edge_u\": [2.1, 0.3, 0]");
        bench.write("scene.json", scene);
        let (address, pictures) = viewer();
        let arguments =
            [&["scene.json", "-q", "-o", "out.exr", "--display", &address], flags].concat();
        bench.make(&arguments, b"");
        let pictures = pictures.join().unwrap();
        let shown = &pictures["out.exr"];
        assert_eq!(pictures.len(), 1);
        assert!(shown.updates > 1, "tiles come one by one: {}", shown.updates);
        let expected: BTreeMap<_, _> =
            fixtures::exr::channels(&bench.read("out.exr")).into_iter().collect();
        assert_eq!(shown.channels.contains_key("A"), flags.contains(&"--alpha"));
        assert!(shown.channels == expected, "{flags:?}");
        assert!(expected["R"].iter().any(|light| *light > 0.0));
    }
}

#[test]
fn a_picture_that_is_only_shown_needs_no_file() {
    let bench = wall();
    let before = bench.names();
    let (address, pictures) = viewer();
    bench.make(&["scene.json", "-q", "--size", "20x10", "--display", &address], b"");
    assert_eq!(pictures.join().unwrap()["scene.json"].size, [20, 10]);
    assert_eq!(bench.names(), before);
}

#[test]
fn variants_are_pictures_of_one_viewer() {
    let bench = wall();
    bench.write("variants.csv", "name,ambient\ndark,0.1\nlight,0.9\n");
    let (address, pictures) = viewer();
    let line = "scene.json -q --size 9x9 --jobs-from variants.csv -o out.exr --display";
    let arguments: Vec<&str> = line.split(' ').chain([address.as_str()]).collect();
    bench.make(&arguments, b"");
    let pictures = pictures.join().unwrap();
    let mean = |name: &str| pictures[name].channels["R"].iter().sum::<f32>();
    assert!(mean("out-dark.exr") < mean("out-light.exr"));
}

#[test]
fn without_a_viewer_nothing_is_made() {
    let address = TcpListener::bind("127.0.0.1:0").unwrap().local_addr().unwrap().to_string();
    let parts = [&format!("--display {address}: no viewer listens there"), "start tev"];
    wall().refuse(&["scene.json", "--display", &address], b"", 5, &parts.map(|part| part));
    for bad in ["127.0.0.1", "127.0.0.1:0", ":14158", "host:port"] {
        let run = wall().run(&["scene.json", "-o", "out.png", "--display", bad], b"");
        let (code, said) = ending(&run);
        assert_eq!(code, Some(2), "{said}");
        assert!(said.contains("expected HOST:PORT, such as 127.0.0.1:14158"), "{said}");
    }
}

#[test]
fn a_viewer_that_goes_away_leaves_the_picture_whole() {
    let bench = wall();
    let listener = TcpListener::bind("127.0.0.1:0").unwrap();
    let address = listener.local_addr().unwrap().to_string();
    let gone = spawn(move || {
        let (mut stream, _) = listener.accept().unwrap();
        // Unread bytes make the system refuse what follows.
        stream.read_exact(&mut [0; 1]).unwrap();
    });
    let size = ["--size", "700x700"];
    let shown = ["scene.json", "-q", "-o", "out.exr", "--display", &address];
    let (code, said) = ending(&bench.run(&[&shown[..], &size].concat(), b""));
    gone.join().unwrap();
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("takes no more tiles"), "{said}");
    assert_eq!(said.lines().count(), 1, "{said}");
    bench.make(&[&["scene.json", "-q", "-o", "alone.exr"], &size[..]].concat(), b"");
    assert!(
        fixtures::exr::channels(&bench.read("out.exr"))
            == fixtures::exr::channels(&bench.read("alone.exr"))
    );
}
