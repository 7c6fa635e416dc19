//! `prv capture`: photos of an object without a service.

use std::path::PathBuf;

use image::{DynamicImage, ImageFormat};
use indicatif::{ProgressBar, ProgressStyle};
use prv::api::{coverage_json, warnings_json};
use prv::geometry::{Point, Pose};
use prv::imaging::{Camera, composite};
use prv::motion::Roll;
use prv::objects::load_object;
use prv::order::Obstacle;
use prv::plan::{
    Arm, ObjectSphere, Plan, PlanRequest, UnreachableViews, ViewShell, ViewSource, ViewStatus, make_plan,
};
use prv::robot::RobotModel;
use prv::simulate::{
    Carrier, End, Flight, Following, MAX_SPEED_FACTOR, Observer, Photo, RenderedObject, Run, SimulateError,
    execute, write_photo_set,
};
use prv::views::Band;

use super::CliResult;
use super::camera_flag::CameraFlag;

/// Photograph an object with the simulated camera: images/*.png and transforms.json.
///
/// The camera flies freely, or hangs on a robot's flange with --robot. What is left out is as in a
/// request to the service.
#[derive(clap::Args)]
pub struct Args {
    /// An OBJ or glTF file, library.sh3f#entry, sample:NAME or made:FAMILY/SEED; with ~texture=N in other textures.
    #[arg(long, env = "PRV_OBJECT")]
    object: String,
    /// `initial` (top, left, front), `initial-five`, or a number of views from 1 to 200.
    #[arg(long, env = "PRV_VIEWS", default_value = "initial")]
    views: String,
    /// Directory to write into; made if it is not there.
    #[arg(long, env = "PRV_OUT")]
    out: PathBuf,
    /// Image size, WIDTHxHEIGHT pixels.
    #[arg(long, env = "PRV_SIZE", default_value = "1280x720", value_parser = size)]
    size: (u32, u32),
    /// Intrinsics: d435, or fx,fy,cx,cy[,k1,k2,p1,p2,k3] in pixels for the size given.
    #[arg(long, env = "PRV_CAMERA", default_value = "d435", allow_hyphen_values = true)]
    camera: CameraFlag,
    /// Centre of the object in the robot's base frame, x,y,z metres.
    #[arg(long, env = "PRV_CENTER", default_value = "0,0,0", value_parser = point, allow_hyphen_values = true)]
    center: Point,
    /// Radius to which the object is scaled, metres.
    #[arg(long, env = "PRV_RADIUS", default_value_t = 0.1)]
    radius: f64,
    /// Distance from the object's centre to the camera, metres.
    #[arg(long, env = "PRV_VIEW_RADIUS", default_value_t = 0.3)]
    view_radius: f64,
    /// Lowest elevation of a view, degrees.
    #[arg(long, env = "PRV_MIN_ELEVATION", default_value_t = 5.0, allow_hyphen_values = true)]
    min_elevation: f64,
    /// Highest elevation of a view, degrees.
    #[arg(long, env = "PRV_MAX_ELEVATION", default_value_t = 90.0, allow_hyphen_values = true)]
    max_elevation: f64,
    /// A robot that carries the camera, by name.
    #[arg(long, env = "PRV_ROBOT")]
    robot: Option<String>,
    /// Whether a view may be turned about its optical axis.
    #[arg(long, env = "PRV_ROLL_FREEDOM", value_enum, default_value_t, requires = "robot")]
    roll: RollArg,
    /// Number of evenly spaced turns to choose among, 1 to 64, with --roll sampled.
    #[arg(long, env = "PRV_ROLL_SAMPLES", required_if_eq("roll", "sampled"), value_parser = clap::value_parser!(u8).range(1..=64))]
    roll_samples: Option<u8>,
    /// What becomes of those of N views that the robot cannot reach.
    #[arg(long, env = "PRV_UNREACHABLE", value_enum, default_value_t, requires = "robot")]
    unreachable: UnreachableArg,
    /// Opaque white behind the object instead of transparency.
    #[arg(long, env = "PRV_WHITE")]
    white: bool,
    /// Print what was done as JSON: `images` in the order in which they were taken, which is that of the
    /// frames in transforms.json; `warnings`, `coverage` and `skipped` as in a plan.
    #[arg(long, env = "PRV_JSON")]
    json: bool,
}

/// The freedom of roll, as `roll` of a request.
#[derive(Clone, Copy, Debug, Default, PartialEq, clap::ValueEnum)]
enum RollArg {
    /// The horizon stays level.
    #[default]
    Fixed,
    /// Chosen among 12 turns for least joint motion.
    Free,
    /// Chosen among --roll-samples turns.
    Sampled,
}

/// What becomes of views out of reach, as `unreachable_views` of a request.
#[derive(Clone, Copy, Debug, Default, PartialEq, clap::ValueEnum)]
enum UnreachableArg {
    /// The set is spread again over what can be reached.
    #[default]
    Replace,
    /// They are left out, with their reasons.
    Skip,
}

/// Takes the photos.
pub fn run(args: &Args) -> CliResult {
    let mesh = load_object(&args.object)?;
    let request = request(args)?;
    let plan = make_plan(&request, Err("captures predict nothing"))?;
    for warning in &plan.warnings {
        eprintln!("warning: {}", warning.message);
    }
    let object = request.object();
    let carrier = carrier(&request, &plan)?;
    let camera = request.camera();
    let rendered = RenderedObject::new(&mesh.fitted(object.center_in_base, object.radius_m), camera);
    std::fs::create_dir_all(args.out.join("images"))?;
    let style = ProgressStyle::with_template("{bar:40} {pos}/{len} photos, {eta} left")?;
    let bar = ProgressBar::new(carrier.shots().len() as u64).with_style(style);
    let mut writer = Writer { args, photos: Vec::new(), bar };
    let run = Run { carrier: &carrier, camera: &rendered, speed_factor: MAX_SPEED_FACTOR };
    let End::Done = execute(&run, &mut writer)? else { return Err("stopped".into()) };
    writer.bar.finish_and_clear();
    write_photo_set(&args.out, &camera, &writer.photos, &object.center_in_base, object.radius_m)?;
    report(args, &plan, &writer.photos)
}

fn request(args: &Args) -> Result<PlanRequest, Box<dyn std::error::Error>> {
    let source = match args.views.as_str() {
        "initial" => ViewSource::Initial { five: false },
        "initial-five" => ViewSource::Initial { five: true },
        number => ViewSource::Count(
            number.parse().map_err(|_| format!("--views {number}: initial, initial-five or a number"))?,
        ),
    };
    let roll = match (args.roll, args.roll_samples) {
        (RollArg::Fixed, None) => Roll::Fixed,
        (RollArg::Free, None) => Roll::FREE,
        (RollArg::Sampled, samples) => Roll::Free { samples: samples.map_or(1, usize::from) },
        (_, Some(_)) => return Err("--roll-samples is for --roll sampled alone".into()),
    };
    let unreachable_views = match args.unreachable {
        UnreachableArg::Replace => UnreachableViews::Replace,
        UnreachableArg::Skip => UnreachableViews::Skip,
    };
    let arm = match &args.robot {
        None => None,
        Some(name) => Some(Arm { roll, unreachable_views, ..Arm::new(RobotModel::named(name)?) }),
    };
    let (width, height) = args.size;
    let camera = scaled(args.camera.for_size(width, height), width, height);
    let center_in_base = args.center;
    Ok(PlanRequest {
        source,
        photo_poses: None,
        camera: Some(camera),
        object: Some(ObjectSphere { center_in_base, radius_m: args.radius, ..ObjectSphere::ASSUMED }),
        shell: ViewShell {
            radius_m: args.view_radius,
            band: Band::from_degrees(args.min_elevation, args.max_elevation)?,
        },
        arm,
    })
}

/// A known camera at another size sees the same picture, coarser or finer.
fn scaled(camera: Camera, width: u32, height: u32) -> Camera {
    let x = f64::from(width) / f64::from(camera.width);
    let y = f64::from(height) / f64::from(camera.height);
    Camera {
        width,
        height,
        fx: camera.fx * x,
        fy: camera.fy * y,
        cx: camera.cx * x,
        cy: camera.cy * y,
        distortion: camera.distortion,
    }
}

fn carrier(request: &PlanRequest, plan: &Plan) -> Result<Carrier, Box<dyn std::error::Error>> {
    if let (Some(arm), Some(trajectory)) = (&request.arm, &plan.trajectory) {
        return Ok(Carrier::Arm {
            motion: Following::new(trajectory.clone(), arm.model.joints.len())?,
            kinematics: arm.model.kinematics.clone(),
            flange_from_camera: arm.mount(),
        });
    }
    let views: Vec<(usize, Pose)> =
        plan.path.order.iter().filter_map(|id| plan.views.get(*id).map(|view| (*id, view.pose))).collect();
    let object = request.object();
    let obstacle =
        Obstacle { center: object.center_in_base, radius_m: object.radius_m, table_z_m: object.table_z_m };
    Ok(Carrier::Free(Flight::through(&views, &obstacle)))
}

/// Writes photos as they are taken.
struct Writer<'a> {
    args: &'a Args,
    photos: Vec<(PathBuf, Pose)>,
    bar: ProgressBar,
}

impl Observer for Writer<'_> {
    fn moved(&mut self, _time_s: f64, _joints_rad: Option<&[f64]>) {}

    fn took(&mut self, photo: Photo<'_>) -> Result<(), SimulateError> {
        let name = PathBuf::from(format!("images/{:03}.png", photo.view));
        let path = self.args.out.join(&name);
        let image: DynamicImage = match self.args.white {
            false => photo.image.clone().into(),
            true => composite(photo.image, [255; 3]).into(),
        };
        image.save_with_format(&path, ImageFormat::Png).map_err(|error| SimulateError::Write {
            path: path.display().to_string(),
            reason: error.to_string(),
        })?;
        self.photos.push((name, photo.base_from_camera));
        self.bar.inc(1);
        Ok(())
    }

    fn cancelled(&self) -> bool {
        false
    }
}

fn report(args: &Args, plan: &Plan, photos: &[(PathBuf, Pose)]) -> CliResult {
    let skipped: Vec<(usize, &str, &str)> = plan
        .views
        .iter()
        .enumerate()
        .filter_map(|(id, view)| match &view.status {
            ViewStatus::Planned => None,
            ViewStatus::Skipped(reason) => Some((id, reason.code, reason.message.as_str())),
        })
        .collect();
    if args.json {
        let skipped: Vec<_> = skipped
            .iter()
            .map(|(id, code, message)| serde_json::json!({"id": id, "code": code, "message": message}))
            .collect();
        let images: Vec<_> = photos.iter().map(|(file, _)| file).collect();
        let answer = serde_json::json!({
            "directory": args.out,
            "robot": args.robot.as_ref().map(|name| name.to_ascii_lowercase()),
            "images": images,
            "skipped": skipped,
            "coverage": plan.coverage.as_ref().map(coverage_json),
            "path_length_m": plan.path.length_m,
            "warnings": warnings_json(&plan.warnings),
        });
        println!("{answer:#}");
    } else {
        for (id, code, message) in skipped {
            eprintln!("view {id} is left out: {code}: {message}");
        }
        println!("{} photos and transforms.json in {}", photos.len(), args.out.display());
    }
    Ok(())
}

fn size(text: &str) -> Result<(u32, u32), String> {
    let parts = text.split_once('x').and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
    parts.ok_or_else(|| "WIDTHxHEIGHT, such as 1280x720".to_owned())
}

fn point(text: &str) -> Result<Point, String> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|part| part.trim().parse()).collect();
    match numbers.as_deref() {
        Ok([x, y, z]) => Ok(Point::new(*x, *y, *z)),
        _ => Err("x,y,z in metres, such as 0.45,0,0.1".to_owned()),
    }
}
