//! `prv render`: one image of one object.

use std::path::PathBuf;

use prv::geometry::{Point, direction_from_azimuth_elevation, look_at};
use prv::imaging::{Camera, composite};
use prv::objects::load_object;
use prv::render::{RenderSettings, Renderer};

use super::CliResult;
use super::camera_flag::CameraFlag;

/// Render an object as a camera on a sphere about it sees it.
#[derive(clap::Args)]
pub struct Args {
    /// OBJ, glTF or .glb file, `library.sh3f#entry.obj`, `sample:NAME` (`sample:NAME:SEED`) or `made:FAMILY/SEED`;
    /// any of them with `~texture=N` in other textures.
    #[arg(long, env = "PRV_OBJECT")]
    object: String,
    /// Azimuth of the camera, degrees from +x towards +y; fronts face -y, that is -90.
    #[arg(long, env = "PRV_AZIMUTH", default_value_t = -60.0, allow_hyphen_values = true)]
    azimuth: f64,
    /// Elevation of the camera, degrees.
    #[arg(long, env = "PRV_ELEVATION", default_value_t = 25.0, allow_hyphen_values = true)]
    elevation: f64,
    /// Distance from the camera to the object's centre, metres.
    #[arg(long, env = "PRV_DISTANCE", default_value_t = 0.3)]
    distance: f64,
    /// Radius of the sphere about the object, metres: the object is scaled to it.
    #[arg(long, env = "PRV_RADIUS", default_value_t = 0.1)]
    radius: f64,
    /// Pixels a side of a square image that shows the whole object.
    #[arg(long, env = "PRV_SIZE", default_value_t = 512, conflicts_with = "camera",
          value_parser = clap::value_parser!(u32).range(1..=8192))]
    size: u32,
    /// Intrinsics instead: d435, or fx,fy,cx,cy[,k1,k2,p1,p2,k3] for 1280x720 pixels.
    #[arg(long, env = "PRV_CAMERA", allow_hyphen_values = true)]
    camera: Option<CameraFlag>,
    /// Samples a pixel: 1, 4, 8 or 16.
    #[arg(long, env = "PRV_SAMPLES", default_value_t = 8)]
    samples: u32,
    /// Background as RRGGBB; clear without.
    #[arg(long, env = "PRV_BACKGROUND", value_parser = rgb)]
    background: Option<[u8; 3]>,
    /// PNG file to write.
    #[arg(long, env = "PRV_OUT")]
    out: PathBuf,
}

fn rgb(text: &str) -> Result<[u8; 3], String> {
    let number = u32::from_str_radix(text.trim_start_matches('#'), 16).ok().filter(|n| *n <= 0xff_ff_ff);
    let [_, r, g, b] = number.ok_or(format!("{text:?} is no colour, must be RRGGBB"))?.to_be_bytes();
    Ok([r, g, b])
}

/// Loads the object, renders it and writes the file.
pub fn run(args: &Args) -> CliResult {
    for (name, value) in [("distance", args.distance), ("radius", args.radius)] {
        if !(value > 0.0 && value < 1e3) {
            return Err(format!("--{name} is {value}, must be greater than 0 and less than 1000 m").into());
        }
    }
    let mesh = load_object(&args.object)?;
    for warning in &mesh.warnings {
        eprintln!("warning: {warning}");
    }
    let camera = match args.camera {
        Some(flag) => flag.for_size(1280, 720),
        None => {
            // Twice the distance is room enough for the tangent to stay finite.
            let sine = (args.radius / args.distance).min(0.95);
            Camera::square(args.size, 1.05 * sine / (1.0 - sine * sine).sqrt())
        }
    };
    camera.check()?;
    let renderer = Renderer::new(&mesh.fitted(Point::origin(), args.radius));
    let direction = direction_from_azimuth_elevation(args.azimuth.to_radians(), args.elevation.to_radians());
    let eye = Point::origin() + direction.into_inner() * args.distance;
    let settings = RenderSettings { samples_per_pixel: args.samples, ..RenderSettings::default() };
    let image = renderer.render(&camera, &look_at(&eye, &Point::origin(), 0.0), &settings);
    match args.background {
        Some(background) => composite(&image, background).save(&args.out)?,
        None => image.save(&args.out)?,
    }
    eprintln!("{}: {} triangles", args.out.display(), renderer.triangle_count());
    Ok(())
}
