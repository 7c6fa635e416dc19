//! `prv serve`: the service.

use std::net::SocketAddr;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use prv::api::{ServiceConfig, serve};
use tracing_subscriber::EnvFilter;

use super::CliResult;

/// Serve the HTTP interface: plans, predictions, simulated runs.
#[derive(clap::Args)]
pub struct Args {
    /// Address to listen on; port 0 takes a free one, which is printed.
    #[arg(long, env = "PRV_LISTEN", default_value = "127.0.0.1:8080")]
    listen: SocketAddr,
    /// Directory for plans and runs; made if it is not there.
    #[arg(long, env = "PRV_DATA_DIR", default_value = "prv-data")]
    data_dir: PathBuf,
    /// Directory below which runs may name object files; none: only samples and uploads.
    #[arg(long, env = "PRV_OBJECTS_DIR")]
    objects_dir: Option<PathBuf>,
    /// Another prediction model than the one in the executable.
    #[arg(long, env = "PRV_MODEL")]
    model: Option<PathBuf>,
    /// Plans and predictions computed at a time; 0 for one a core.
    #[arg(long, env = "PRV_WORKERS", default_value_t = 0)]
    workers: usize,
    /// Plans and predictions that may wait; more are refused with 503 and Retry-After.
    #[arg(long, env = "PRV_QUEUE", default_value_t = 16)]
    queue: usize,
    /// Simulated arms that move at a time; further runs wait.
    #[arg(long, env = "PRV_ARMS", default_value = "2")]
    arms: NonZeroUsize,
    /// Seconds after which a request is answered with 503 and its work stopped; a plan finished before is stored.
    #[arg(long, env = "PRV_REQUEST_TIMEOUT_S", default_value_t = 120, value_parser = clap::value_parser!(u64).range(1..))]
    request_timeout_s: u64,
    /// Seconds that what is under way gets when the service stops.
    #[arg(long, env = "PRV_SHUTDOWN_TIMEOUT_S", default_value_t = 10)]
    shutdown_timeout_s: u64,
    /// Log as JSON, one object a line.
    #[arg(long, env = "PRV_LOG_JSON")]
    log_json: bool,
    /// What to log, as `tracing` writes filters: `info`, `prv=debug`, ..
    #[arg(long, env = "PRV_LOG", default_value = "info,ort=warn")]
    log: String,
}

/// Serves until SIGINT or SIGTERM.
pub fn run(args: &Args) -> CliResult {
    let filter = EnvFilter::try_new(&args.log)?;
    let log = tracing_subscriber::fmt().with_env_filter(filter).with_writer(std::io::stderr);
    if args.log_json {
        log.json().init()
    } else {
        log.init()
    }
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    let config = ServiceConfig {
        address: args.listen,
        data_dir: args.data_dir.clone(),
        objects_dir: args.objects_dir.clone(),
        model: args.model.clone(),
        workers: if args.workers == 0 { cores } else { args.workers },
        queue: args.queue,
        arms: args.arms.get(),
        request_timeout: Duration::from_secs(args.request_timeout_s),
        shutdown_timeout: Duration::from_secs(args.shutdown_timeout_s),
    };
    let runtime = tokio::runtime::Builder::new_multi_thread().enable_all().build()?;
    let served = runtime.block_on(async {
        let stop = stop_signal()?;
        let bound = |address| println!("listening on http://{address} (interface: /docs)");
        serve(config, bound, stop).await
    });
    // Whoever is still computing is not waited for: what it would store is computed again when asked.
    runtime.shutdown_background();
    Ok(served.map_err(|error| {
        format!("cannot serve on {} from {}: {error}", args.listen, args.data_dir.display())
    })?)
}

/// Completes at SIGINT or SIGTERM.
#[cfg(unix)]
fn stop_signal() -> std::io::Result<impl Future<Output = ()> + Send + 'static> {
    use tokio::signal::unix::{SignalKind, signal};
    let (mut interrupt, mut terminate) = (signal(SignalKind::interrupt())?, signal(SignalKind::terminate())?);
    Ok(async move {
        tokio::select! {
            _ = interrupt.recv() => {}
            _ = terminate.recv() => {}
        }
    })
}

/// Completes at Ctrl-C.
#[cfg(not(unix))]
fn stop_signal() -> std::io::Result<impl Future<Output = ()> + Send + 'static> {
    Ok(async {
        if tokio::signal::ctrl_c().await.is_err() {
            std::future::pending::<()>().await;
        }
    })
}
