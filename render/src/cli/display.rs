//! An image viewer to which finished tiles are sent: tev, or another program with its protocol.
//!
//! The protocol is that of tev (<https://github.com/Tom94/tev>, `src/Ipc.cpp`) over TCP. A picture is closed by its name,
//! if the viewer shows an older one, and is then created anew. Each tile follows as 32-bit floats in linear RGB, which are
//! the numbers of an EXR file. A picture with a transparent background has a channel `A`, which is sent last.
//!
//! A viewer that goes away does not end the work: the picture is finished without it.

use files::exit::say;
use files::{Exit, Failure, words};
use render::film::{Crop, alpha};
use render::{Picture, Settings};
use std::io;
use std::net::{TcpStream, ToSocketAddrs};
use std::sync::{Mutex, PoisonError};
use std::time::Duration;
use tev_client::{PacketCloseImage, PacketCreateImage, PacketUpdateImage, TevClient};
use thiserror::Error;

/// Time in which a viewer must answer or take a tile. A shorter one would lose viewers that are busy with a large
/// picture, and a longer one delays the message.
const PATIENCE: Duration = Duration::from_secs(5);

/// Most numbers of one packet of the coverage.
const MOST: usize = 1 << 20;

/// The channels of the colour.
const COLOR: [&str; 3] = ["R", "G", "B"];

/// No viewer listens.
#[derive(Debug, Error)]
#[error(
    "--display {address}: no viewer listens there ({source}): start tev, or name the HOST:PORT of another one"
)]
pub struct NoViewer {
    address: String,
    source: io::Error,
}

impl Failure for NoViewer {
    fn exit(&self) -> Exit {
        Exit::ReadWrite
    }
}

/// Reads the value of --display.
pub fn address(text: &str) -> Result<String, String> {
    let is_address = text.rsplit_once(':').is_some_and(|(host, port)| {
        !host.is_empty() && port.parse::<u16>().is_ok_and(|port| port > 0)
    });
    let text = text.to_owned();
    is_address.then_some(text).ok_or_else(|| "expected HOST:PORT, such as 127.0.0.1:14158".into())
}

/// A connection to a viewer.
pub struct Display {
    address: String,
    /// `None` once the viewer has gone.
    client: Mutex<Option<TevClient>>,
}

impl Display {
    /// Connects to the viewer that listens on a host and a port.
    ///
    /// # Errors
    /// When there is no such host, or nobody listens there.
    pub fn connect(address: &str) -> Result<Self, NoViewer> {
        let failed = |source| NoViewer { address: address.into(), source };
        let mut last = io::Error::new(io::ErrorKind::NotFound, "the host is unknown");
        for place in address.to_socket_addrs().map_err(failed)? {
            let connected = TcpStream::connect_timeout(&place, PATIENCE).and_then(|stream| {
                stream.set_write_timeout(Some(PATIENCE))?;
                Ok(stream)
            });
            match connected {
                Ok(stream) => {
                    let client = Mutex::new(Some(TevClient::wrap(stream)));
                    return Ok(Self { address: address.into(), client });
                }
                Err(error) => last = error,
            }
        }
        Err(failed(last))
    }

    /// Shows a black picture with this name and the size of the settings.
    pub fn begin<'d>(&'d self, name: &str, settings: &Settings, has_alpha: bool) -> Image<'d> {
        // The protocol ends names with a zero byte.
        let image = Image { display: self, name: name.replace('\0', ""), crop: Crop::of(settings) };
        let Crop { width, height, .. } = image.crop;
        let image_name = &image.name;
        self.send(|client| {
            client.send(PacketCloseImage { image_name })?;
            let channel_names: &[&str] =
                if has_alpha { &["R", "G", "B", alpha::NAME] } else { &COLOR };
            let grab_focus = true;
            client.send(PacketCreateImage { image_name, grab_focus, width, height, channel_names })
        });
        image
    }

    /// Sends something, unless the viewer has gone. If it goes now, a line says so once.
    fn send(&self, send: impl FnOnce(&mut TevClient) -> io::Result<()>) {
        let mut client = self.client.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(Err(error)) = client.as_mut().map(send) {
            *client = None;
            let address = words::shown(&self.address);
            say(format_args!(
                "render: the viewer at {address} takes no more tiles ({error}): the picture is finished without it"
            ));
        }
    }
}

/// A picture in the viewer.
pub struct Image<'d> {
    display: &'d Display,
    name: String,
    crop: Crop,
}

impl Image<'_> {
    /// Shows a tile. Its place is that in the whole picture; `pixels` are linear RGB, row by row.
    pub fn show(&self, tile: &Crop, pixels: &[[f32; 3]]) {
        self.update(tile, &COLOR, pixels.as_flattened());
    }

    /// Shows the coverage of a finished picture, if it has one.
    pub fn complete(&self, picture: &Picture) {
        let Some(coverage) = alpha::coverage(picture) else { return };
        let Crop { x, width, .. } = self.crop;
        let rows = (MOST / width as usize).max(1);
        let strips = coverage.chunks(rows * width as usize);
        for (y, strip) in (self.crop.y..).step_by(rows).zip(strips) {
            let height = (strip.len() / width as usize) as u32;
            self.update(&Crop { x, y, width, height }, &[alpha::NAME], strip);
        }
    }

    /// Sends the values of some channels in a rectangle, those of a pixel one after another.
    fn update(&self, place: &Crop, channel_names: &[&str], data: &[f32]) {
        let count = channel_names.len() as u64;
        let offsets: Vec<u64> = (0..count).collect();
        self.display.send(|client| {
            client.send(PacketUpdateImage {
                image_name: &self.name,
                grab_focus: false,
                channel_names,
                channel_offsets: &offsets,
                channel_strides: &vec![count; offsets.len()],
                x: place.x - self.crop.x,
                y: place.y - self.crop.y,
                width: place.width,
                height: place.height,
                data,
            })
        });
    }
}
