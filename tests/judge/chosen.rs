//! Which causes a case hides.

use super::pick;
use ident::ground::random::Random;

/// How a kind's cases are shared out, of twenty: clean below the first, one cause below the second, two
/// below the third, something from outside the library above.
pub const USUAL: [usize; 3] = [4, 14, 18];

/// No cause, one, two different ones or one from outside, as the class falls that is drawn; only causes
/// that `fits` lets pass.
pub fn chosen(
    random: &mut Random,
    shares: [usize; 3],
    [inside, outside]: [&[&'static str]; 2],
    fits: impl Fn(&str) -> bool,
) -> Vec<&'static str> {
    let class = random.below(20);
    let from = if class >= shares[2] { outside } else { inside };
    let count = match class {
        c if c < shares[0] => 0,
        c if (shares[1]..shares[2]).contains(&c) => 2,
        _ => 1,
    };
    let mut names: Vec<&'static str> = Vec::new();
    while names.len() < count {
        let name = *pick(random, from);
        if !names.contains(&name) && fits(name) {
            names.push(name);
        }
    }
    names
}
