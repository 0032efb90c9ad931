//! A stated limit: the points of a test that are diagnosed. Memory goes with the points; so does the
//! time of one set of causes, but sets grow in number as points do.

use crate::fit::suitability::{Doubt, Weight};
use crate::measurement::workspace_test::WorkspaceTest;

/// Points that are diagnosed at most: of 900 points whose rest bends, all took 10 s, 500 take 4 s. Half the points
/// widen an interval by two fifths.
pub const MOST_POINTS: usize = 500;

/// The test with at most [`MOST_POINTS`] of its points, evenly spread over the file, and what to say of that.
pub fn thinned(test: &WorkspaceTest) -> Option<(WorkspaceTest, Doubt)> {
    let mut points: Vec<usize> = test.steps.iter().map(|s| s.point).collect();
    points.sort_unstable();
    points.dedup();
    let all = points.len();
    if all <= MOST_POINTS {
        return None;
    }
    let kept: Vec<usize> = (0..MOST_POINTS)
        .map(|i| points[i * all / MOST_POINTS])
        .collect();
    let steps = test
        .steps
        .iter()
        .filter(|s| kept.binary_search(&s.point).is_ok());
    let doubt = Doubt {
        rule: "many-points",
        weight: Weight::Note,
        what: format!(
            "of {all} points {MOST_POINTS}, evenly spread, are diagnosed: that is the limit"
        ),
        remedy: "give fewer points in a file to choose them yourself",
    };
    let thin = WorkspaceTest {
        steps: steps.copied().collect(),
        facts: test.facts.clone(),
        path: test.path.clone(),
        sha256: test.sha256.clone(),
        rows: test.rows,
        left_out: test.left_out,
        from_unloaded: test.from_unloaded,
    };
    Some((thin, doubt))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::workspace::columns::{Columns, Rows};
    use crate::findings::workspace::patterns::Scene;
    use crate::findings::workspace::seats::Seats;
    use crate::fit::force_shapes::Shapes;
    use crate::fit::weighing::Weighing;
    use crate::measurement::table::Table;
    use std::path::Path;

    fn test_of(points: usize) -> WorkspaceTest {
        let angle = |p: usize| 40.0 * (p as f64 / points as f64 - 0.5);
        let rows: String = (0..points)
            .map(|p| format!("#   [{0}, -85.0, 95.0, 0.0, 75.0, {0}],\n", angle(p)))
            .collect();
        let mut text = format!(
            "# kind = \"workspace\"\n# robot = \"kr210\"\n# joint_angles_deg = [\n{rows}# ]\npoint,direction,cycle,force_N,dx_mm,dy_mm,dz_mm\n"
        );
        for (p, d) in (1..=points).flat_map(|p| [(p, "x"), (p, "y"), (p, "z")]) {
            for force in [0.0, 300.0, 0.0, -300.0] {
                text += &format!("{p},{d},1,{force},{0},{0},{0}\n", 1e-3 * force);
            }
        }
        let table = Table::from_reader(Path::new("w.csv"), text.as_bytes(), text.len() as u64);
        WorkspaceTest::from_table(table.unwrap()).unwrap()
    }

    #[test]
    fn no_more_points_than_the_limit_are_kept_and_all_up_to_it() {
        assert!(thinned(&test_of(MOST_POINTS)).is_none());
        let (thin, doubt) = thinned(&test_of(MOST_POINTS + 7)).unwrap();
        assert_eq!(Shapes::of(&thin).setups.len(), 3 * MOST_POINTS);
        assert!(doubt.what.contains("of 507 points 500"), "{}", doubt.what);
    }

    /// Numbers that the columns hold: what memory goes with.
    fn numbers(points: usize) -> usize {
        let test = test_of(points);
        let robot = crate::robot::load("kr210", None).unwrap().robot;
        let shapes = Shapes::of(&test);
        let seats = Seats::of(&Scene::of(&robot, &test.facts.joint_angles), &shapes);
        let weighing = Weighing::new(&shapes.setups, 0.0);
        let patterns = seats.columns.iter().map(|c| &c.pattern);
        let columns = Columns::of(patterns, &weighing, 0);
        let held = |rows: &Rows| match rows {
            Rows::Wide(slopes, _) => slopes.len(),
            Rows::Local(_, own) => own.len(),
        };
        columns.all().iter().map(held).sum()
    }

    #[test]
    fn memory_goes_with_the_points() {
        assert_eq!(numbers(60), 3 * numbers(20));
    }
}
