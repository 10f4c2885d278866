//! One measurement of motiform: `motiform-bench TASK key=value ...` prints one JSON object.

mod amplitudes;
mod exponents;
mod noisy;
mod options;
mod orbits;

use options::Options;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let task = words.next().unwrap_or_default();
    let options = Options::parse(words)?;
    let result = match task.as_str() {
        "adaptive" | "short" => orbits::adaptive(&options, &task)?,
        "amplitudes" => amplitudes::amplitudes(&options)?,
        "noisy" => noisy::noisy(&options)?,
        "lyapunov" => exponents::spectra(&options)?,
        other => return Err(format!("no task {other:?}: adaptive, amplitudes, noisy, short, lyapunov").into()),
    };
    println!("{result}");
    Ok(())
}
