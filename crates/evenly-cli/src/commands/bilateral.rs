//! `evenly bilateral`: how well a few pixels, chosen by points, stand for all.

use std::path::PathBuf;

use anyhow::bail;
use evenly::{BilateralParams, bilateral, subsampled_bilateral};
use evenly_io::{Target, read_image, write_image};

use crate::measuring_args::Bilateral;
use crate::{files, measured, record, session};

pub fn run(args: &Bilateral) -> anyhow::Result<u8> {
    let target = |path: &Option<PathBuf>| path.as_ref().map(|path| Target::picture(path, args.measured.force)).transpose();
    let (output, full) = (target(&args.output)?, target(&args.full)?);
    if output.as_ref().zip(full.as_ref()).is_some_and(|(output, full)| output.is_same(full)) {
        bail!("--output and --full are the same file");
    }
    files::require_one_stdin([&args.input, &args.samples])?;
    let image = read_image(&args.input)?;
    let samples = files::read_points(&args.samples, &args.space)?;
    let params = BilateralParams { kernel_px: args.kernel, range: args.range, n_samples: args.count };
    let pool = session::pool(args.measured.threads, false)?;
    let told = |e| measured::told(e, &args.samples, &[("kernel_px", "kernel"), ("n_samples", "count")]);
    let few = pool.install(|| subsampled_bilateral(&image, &samples, &params)).map_err(told)?;
    let all = pool.install(|| bilateral(&image, &params))?;
    for (image, target) in [(&few, &output), (&all, &full)] {
        if let Some(target) = target {
            write_image(image, &record::recipe(None), target)?;
        }
    }
    let json = serde_json::json!(few.difference(&all)?);
    measured::print(&json, args.measured.json, || measured::table(&json))
}
