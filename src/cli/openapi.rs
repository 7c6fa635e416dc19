//! `prv openapi`: the document of the HTTP interface.

use super::CliResult;

/// Print the OpenAPI document (committed as openapi/openapi.json).
#[derive(clap::Args)]
pub struct Args {}

/// Prints it.
pub fn run(_args: &Args) -> CliResult {
    print!("{}", prv::api::openapi_json());
    Ok(())
}
