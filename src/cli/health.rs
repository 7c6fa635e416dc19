//! `prv health`: is the service up? For container health checks, where no curl is at hand.

use std::io::{Read, Write};
use std::net::{SocketAddr, TcpStream};
use std::time::Duration;

use super::CliResult;

/// Asks a running service whether it is ready; exit code 0 when it is.
#[derive(clap::Args)]
pub struct Args {
    /// Address the service listens on; 0.0.0.0 is asked on the loopback interface.
    #[arg(long, env = "PRV_LISTEN", default_value = "127.0.0.1:8080")]
    listen: SocketAddr,
    /// Seconds to wait for the answer.
    #[arg(long, env = "PRV_HEALTH_TIMEOUT_S", default_value_t = 2)]
    timeout_s: u64,
    /// Path to ask.
    #[arg(long, env = "PRV_HEALTH_PATH", default_value = "/readyz")]
    path: String,
}

/// Runs the check.
pub fn run(args: &Args) -> CliResult {
    let mut address = args.listen;
    if address.ip().is_unspecified() {
        address.set_ip(if address.is_ipv4() {
            std::net::Ipv4Addr::LOCALHOST.into()
        } else {
            std::net::Ipv6Addr::LOCALHOST.into()
        });
    }
    let timeout = Duration::from_secs(args.timeout_s.max(1));
    let mut stream =
        TcpStream::connect_timeout(&address, timeout).map_err(|error| format!("{address}: {error}"))?;
    stream.set_read_timeout(Some(timeout))?;
    stream.set_write_timeout(Some(timeout))?;
    write!(stream, "GET {} HTTP/1.0\r\nHost: {address}\r\n\r\n", args.path)?;
    let mut answer = String::new();
    stream.take(64 * 1024).read_to_string(&mut answer)?;
    let status = answer.split_whitespace().nth(1).unwrap_or("no status");
    if status == "200" {
        println!("ready");
        return Ok(());
    }
    let body = answer.split_once("\r\n\r\n").map_or("", |(_, body)| body);
    Err(format!("{} answered {status}: {body}", args.path).into())
}
