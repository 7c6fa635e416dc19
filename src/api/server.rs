//! The running service.

use std::future::Future;
use std::io;
use std::net::SocketAddr;

use tokio::net::TcpListener;

use super::config::ServiceConfig;
use super::router::router;
use super::state::AppState;

/// Serves until `stop` completes, then lets requests end and marks runs as interrupted.
///
/// `bound` is told the address once requests are taken (port 0 asks for a free one).
///
/// # Errors
/// An address or data directory that cannot be used.
pub async fn serve(
    config: ServiceConfig,
    bound: impl FnOnce(SocketAddr),
    stop: impl Future<Output = ()> + Send + 'static,
) -> io::Result<()> {
    let listener = TcpListener::bind(config.address).await?;
    let address = listener.local_addr()?;
    let patience = config.shutdown_timeout;
    // Loading the model and reading the store take a moment.
    let app =
        tokio::task::spawn_blocking(move || AppState::open(config)).await.map_err(io::Error::other)??;
    let executions = app.executions.clone();
    tracing::info!(%address, "serving");
    bound(address);

    let (stopping, mut stopped) = tokio::sync::watch::channel(false);
    let stop_runs = async move {
        stop.await;
        tracing::info!("stopping");
        // Streams of events end with their runs.
        executions.shut_down(patience).await;
        let _ = stopping.send(true);
    };
    let stop_accepting = async move {
        let _ = stopped.wait_for(|stopped| *stopped).await;
    };
    let stop_runs = tokio::spawn(stop_runs);
    let server = axum::serve(listener, router(app)).with_graceful_shutdown(stop_accepting);
    let mut server = std::pin::pin!(server.into_future());
    tokio::select! {
        ended = &mut server => ended?,
        _ = stop_runs => match tokio::time::timeout(patience, server).await {
            Ok(ended) => ended?,
            Err(_) => tracing::warn!("requests under way are cut off"),
        },
    }
    Ok(())
}
