//! `asperity trade`.

mod progress;

use std::path::{Path, PathBuf};

use clap::Args;

use crate::output::RunFolder;
use crate::output::run_json::write_atomic;
use crate::study::trade::{Advice, Aim, Ending, QUANTITIES, Stop, Trade, Wish, search, write_figures, write_table};

use super::SceneArguments;
use super::outcome::{Exit, Failure, say};
use super::run::{default_folder, on_interrupt};
use progress::Progress;

#[derive(Debug, Args)]
pub struct TradeArguments {
    #[command(flatten)]
    scene: SceneArguments,
    /// Quantities whose errors count, by commas [default: fx,fy,mu_global where they say something].
    ///
    /// The largest of their errors decides. All of them stand in trade.csv.
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = clap::builder::PossibleValuesParser::new(QUANTITIES))]
    quantity: Vec<String>,
    /// Recommend the smallest error for runs of this CPU time, and look there first.
    #[arg(long, value_name = "SECONDS", value_parser = positive, conflicts_with = "error")]
    budget: Option<f64>,
    /// Recommend the cheapest settings for this error (0.01 is 1 % of the peak), and look there first.
    #[arg(long, value_name = "TARGET", value_parser = positive)]
    error: Option<f64>,
    /// CPU time that the whole search may take.
    #[arg(long, value_name = "SECONDS", value_parser = positive, default_value_t = 300.0)]
    effort: f64,
    /// Folder of the results; made if it does not exist [default: out/<name of the scene>-trade].
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print errors only.
    #[arg(long)]
    quiet: bool,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number > 0.0 && number.is_finite() => Ok(number),
        _ => Err("a number above 0 is allowed".into()),
    }
}

/// Measures settings of a scene, writes table, figures and recommended scene, and prints the recommendation.
pub fn command(arguments: &TradeArguments) -> Result<Exit, Failure> {
    let trade = Trade::load(&arguments.scene.scene, &arguments.scene.sets)?;
    let out = arguments.out.clone().unwrap_or_else(|| trade_folder(&arguments.scene.scene));
    let refused = |error| Failure::input(format!("{error}\n  = argument: --out {}", out.display()));
    RunFolder::create(&out).map_err(refused)?;
    let wish = wish(arguments);
    let interrupt = on_interrupt()?;
    let mut progress = Progress::new(wish.effort, arguments.quiet);
    let found = search(&trade, &wish, &out, &interrupt, &mut |event| progress.take(&event));
    progress.end();
    let found = match found {
        Ok(found) => found,
        Err(Stop::Interrupted) => return Ok(Exit::Interrupted),
        Err(Stop::Output(error)) => return Err(Failure::internal(error)),
        Err(stop @ Stop::TooLittle(_)) => {
            return Err(Failure::input(format!("{stop}\n  = help: a larger --effort, or a coarser scene")));
        }
        Err(stop @ Stop::NoReference(_)) => return Err(Failure::not_converged(stop)),
    };
    let advice = Advice::new(&trade, &found, wish.aim);
    let text = advice.text();
    write_table(&trade, &found, &out).map_err(Failure::internal)?;
    write_figures(&trade, &found, &out).map_err(Failure::internal)?;
    write_atomic(&out.join("trade.md"), page(&trade, &text).as_bytes()).map_err(Failure::internal)?;
    let recommended = advice.write_scene(&out).map_err(Failure::internal)?;
    if !arguments.quiet {
        let scene = recommended.map_or(String::new(), |path| format!("recommended settings: {}\n", path.display()));
        say(&format!(
            "{text}\n{scene}table, figures and how the error is measured: {}\n",
            out.join("trade.md").display()
        ))?;
    }
    Ok(if found.ending == Ending::Interrupted { Exit::Interrupted } else { Exit::Done })
}

fn wish(arguments: &TradeArguments) -> Wish {
    let number = |name: &String| QUANTITIES.iter().position(|known| known == name);
    Wish {
        quantities: arguments.quantity.iter().filter_map(number).collect(),
        aim: match (arguments.error, arguments.budget) {
            (Some(target), _) => Aim::Error(target),
            (_, Some(budget)) => Aim::Budget(budget),
            _ => Aim::Front,
        },
        effort: arguments.effort,
    }
}

fn trade_folder(scene: &Path) -> PathBuf {
    let mut name = default_folder(scene).into_os_string();
    name.push("-trade");
    name.into()
}

/// `trade.md`: the recommendation, and what the figures mean.
fn page(trade: &Trade, text: &str) -> String {
    format!("# Work and precision: {}\n\n{text}\n{MEANING}", trade.scene().title)
}

const MEANING: &str = "\
![Work and precision](figures/work-precision.svg)

## How to read this

- **Error** of a curve (`error_fx`, ... in `trade.csv`): root mean square over the time in contact of its difference from the
  reference, relative to the peak of the reference; at the nominal times of whichever of the two has fewer steps, straight lines between
  the nominal times of the other. `mu_global` counts with the weight `fy`. `error` is the largest of those asked for.
- **bound**: the larger of `error` and the reference's own, plus the reference's own. Recommendations meet their target with it.
- **Own error of the reference**: from its last refinements, each of elements and steps together. With d1 and d2 the last two changes,
  it is d1/(d2/d1 - 1), the ratio credited from 2 to 4; d1 where the ratio is below 2.
- **cpu_s**: CPU time of one run on one thread with `history.csv` and `run.json` only; **memory_mb**: peak of the process.
- `elements` and `grading` are factors on those of the scene, `steps` is the number of nominal steps; `choices` lists what else differs.
- There is no tolerance of Newton's method to choose, and whether a falling friction law is lagged is decided by the program.
- Settings lie in `points/`, each with `history.csv` and `run.json`.
";
