//! The conformance kit judges the oracle itself, in its own precision and rounded to a lower one.

mod common;

use psmrt::oracle::judge;
use psmrt::oracle::reference::Oracle;

#[test]
fn oracle_passes() {
    let verdict = judge(&mut Oracle).unwrap();
    println!("{verdict}");
    assert!(verdict.passed());
}
#[test]
fn model_agrees() {
    use psmrt::oracle::kit::Kit; use psmrt::oracle::model::Model;
    let kit = Kit::make().unwrap();
    let model = Model::right();
    for s in &kit.problems {
        let a = model.answer(&s.problem);
        for e in &s.expected {
            let v = &a.values.get(e.spec.name).unwrap().values;
            let r = v.iter().zip(&e.values.values).zip(&e.gauges.values).map(|((a,b),g)| if a==b {0.0} else {(a-b).abs()/g/f64::EPSILON}).fold(0.0,f64::max);
            let gmax = e.gauges.values.iter().copied().fold(0.0,f64::max);
            let vmax = e.values.values.iter().copied().map(f64::abs).fold(0.0,f64::max);
            println!("{} {} {} {r:.3} vmax {vmax:.3e} gmax {gmax:.3e}", s.problem.stage, s.problem.id, e.spec.name);
        }
    }
}
