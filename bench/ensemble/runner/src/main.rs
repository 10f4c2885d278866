//! One measurement of motiform: `motiform-bench TASK key=value ...` prints one JSON object.

mod cell;
mod exponents;
mod options;
mod orbits;

use options::Options;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut words = std::env::args().skip(1);
    let task = words.next().unwrap_or_default();
    let options = Options::parse(words)?;
    let result = match task.as_str() {
        "rk4" => orbits::rk4(&options)?,
        "adaptive" | "short" => orbits::adaptive(&options, &task)?,
        "lyapunov" => exponents::spectra(&options)?,
        "cell" => cell::cell(&options)?,
        other => return Err(format!("no task {other:?}: rk4, adaptive, short, lyapunov, cell").into()),
    };
    println!("{result}");
    Ok(())
}
