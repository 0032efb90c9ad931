//! `ident completions`: what a shell needs to complete words, and the manual page.

use super::output::print;
use super::{Ending, Verb, arguments, command, parsed};
use crate::ground::problem::{Outcome, Problem};
use clap::{ArgMatches, Args, ValueEnum};
use clap_complete::Shell;

/// The verb.
pub const VERB: Verb = Verb {
    name: "completions",
    about: "Print the completions of a shell, or the manual page (man)",
    arguments: arguments::<Arguments>,
    run,
};

#[derive(Args)]
struct Arguments {
    /// bash, zsh, fish, powershell, elvish, or man for the manual page
    shell: String,
}

fn run(matches: &ArgMatches) -> Outcome<Ending> {
    let arguments: Arguments = parsed(matches);
    let mut text = Vec::new();
    match Shell::from_str(&arguments.shell, true) {
        Ok(shell) => clap_complete::generate(shell, &mut command(), "ident", &mut text),
        Err(_) if arguments.shell == "man" => manual(&mut text)?,
        Err(_) => {
            let what = format!("`{}` is no shell that is known", arguments.shell);
            let remedy = "give one of bash, zsh, fish, powershell, elvish, man";
            return Err(Problem::new(what, remedy));
        }
    }
    print(&String::from_utf8_lossy(&text))?;
    Ok(Ending::Done)
}

/// The page of `ident` and one section per verb.
fn manual(text: &mut Vec<u8>) -> Outcome<()> {
    let failed = |e: std::io::Error| {
        Problem::new(
            format!("the manual page cannot be made ({e})"),
            "tell its authors",
        )
    };
    let root = command();
    clap_mangen::Man::new(root.clone())
        .render(text)
        .map_err(failed)?;
    for verb in root.get_subcommands() {
        let page = clap_mangen::Man::new(verb.clone());
        text.extend(format!(".SH \"IDENT {}\"\n", verb.get_name().to_uppercase()).bytes());
        page.render_description_section(text).map_err(failed)?;
        page.render_options_section(text).map_err(failed)?;
    }
    Ok(())
}
