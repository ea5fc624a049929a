//! Films that `ffmpeg` makes of frames. Where it is missing, the tests say so.
#![cfg(unix)]

use crate::support::animated::{folder, pixels};
use crate::support::{programs, run, said, shell};
use std::process::Command;

/// Each frame of a film, decoded again, looks like its picture. All formats of ffmpeg are tried.
#[test]
fn a_film_of_ffmpeg_shows_the_frames() {
    let folder = folder(r#""turntable": { "frames": 5, "fps": 10 }"#);
    let path = folder.path();
    if !shell("ffmpeg -version", path).status.success() {
        println!("skipped: ffmpeg is not installed");
        return;
    }
    // Sides that are odd are padded to even ones.
    for (film, size) in
        [("a.mp4", "64x48"), ("a.mkv", "63x47"), ("a.mov", "64x48"), ("a.webm", "64x48")]
    {
        let flags = ["-o", "out", "-q", "--size", size, "--film", film];
        let ran = run("pipeline", &[&["run", "jobs/job.json"], &flags[..]].concat(), path);
        assert!(ran.status.success(), "{film}: {}", said(&ran));
        let ran = shell(&format!("rm -f got-*.png && ffmpeg -v error -i {film} got-%d.png"), path);
        assert!(ran.status.success(), "{film}: {}", said(&ran));
        for k in 1..=5 {
            let own = pixels(&path.join(format!("out/job-exact.000{k}.png")));
            let shown = pixels(&path.join(format!("got-{k}.png")));
            let even = |side: u32| side.div_ceil(2) * 2;
            assert_eq!(shown.dimensions(), (even(own.width()), even(own.height())), "{film}");
            let codes = own.enumerate_pixels().flat_map(|(x, y, pixel)| {
                let shown = shown.get_pixel(x, y).0;
                [0, 1, 2].map(|c| f64::from(pixel.0[c].abs_diff(shown[c])))
            });
            let count = f64::from(3 * own.width() * own.height());
            let mean = codes.sum::<f64>() / count;
            // Colours are halved across and down, which blurs the edges of these few pixels. Another frame
            // differs by 12 codes and more.
            assert!(mean < 6.0, "{film}, frame {k}: {mean} codes");
        }
        assert!(!path.join("got-6.png").exists(), "{film}");
    }
}

#[test]
fn without_ffmpeg_one_sentence_says_so() {
    let folder = folder(r#""turntable": { "frames": 2 }"#);
    let ran = Command::new(programs().join("pipeline"))
        .args(["run", "jobs/job.json", "-o", "out", "--film", "a.mp4"])
        .env("PATH", folder.path())
        .current_dir(folder.path())
        .output()
        .unwrap();
    assert_eq!(ran.status.code(), Some(2));
    let text = said(&ran);
    assert!(
        text.contains("--film a.mp4 needs the program ffmpeg") && text.lines().count() == 1,
        "{text}"
    );
    assert!(!folder.path().join("out/job-exact.0001.png").exists(), "nothing is rendered before");
}
