//! `evenly zoneplate`: how points sample waves.

use evenly::{ZonePlateParams, zone_plate};
use evenly_io::{Target, write_image};

use crate::measuring_args::Zoneplate;
use crate::{files, measured, record, session};

pub fn run(args: &Zoneplate) -> anyhow::Result<u8> {
    let output = args.output.as_ref().map(|path| Target::picture(path, args.measured.force)).transpose()?;
    let points = files::read_points(&args.input, &args.space)?;
    let params = ZonePlateParams { pixels: args.pixels, max_frequency: args.frequency, filter: args.filter.into() };
    let pool = session::pool(args.measured.threads, false)?;
    let plate =
        pool.install(|| zone_plate(&points, &params)).map_err(|e| measured::told(e, &args.input, &[("max_frequency", "frequency")]))?;
    if let Some(output) = &output {
        write_image(&plate.image, &record::recipe(None), output)?;
    }
    let json = serde_json::json!(plate);
    measured::print(&json, args.measured.json, || measured::table(&json))
}
