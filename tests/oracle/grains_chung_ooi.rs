//! Chung & Ooi's benchmarks of contact (Granular Matter 13, 643 (2011)), tests 1 to 8, with elastic spheres: against the
//! closed forms of Hertz, the exact impulses of sliding, the published curves, and the experiment of Kharaz, Gorham &
//! Salman, Powder Technol. 120, 281 (2001).

use crate::common;

use common::golden_rows;
use psmrt_reference::grains::grain::Grain;
use psmrt_reference::grains::hertz::{Elastic, HertzLaw};
use psmrt_reference::grains::plane::Plane;
use psmrt_reference::grains::setup::GrainSetup;
use psmrt_reference::grains::system::GrainSystem;
use psmrt_reference::lattice::Vec3;

/// Sub-steps in a contact.
const FINE: f64 = 1000.0;

/// A row of the table, SI units.
struct Row {
    material: String,
    elastic: Elastic,
    density: f64,
    friction: f64,
    /// As printed: a number, or a range.
    restitution: String,
    radius: f64,
    speed: f64,
    /// Largest force and overlap, and duration, by Hertz; none for some.
    hertz: Option<[f64; 3]>,
}

fn rows(test: &str) -> Vec<Row> {
    let table = golden_rows("dem/chung_ooi_hertz.csv");
    let of_test = table.iter().filter(|row| &row[0] == test);
    let rows: Vec<Row> = of_test
        .map(|row| {
            let number = |column: usize| row[column].parse::<f64>().unwrap();
            Row {
                material: row[1].to_owned(),
                elastic: Elastic { youngs_modulus: number(2), poisson_ratio: number(3) },
                density: number(4),
                friction: number(5),
                restitution: row[6].to_owned(),
                radius: number(7),
                speed: number(8),
                hertz: (!row[9].is_empty()).then(|| [number(9), number(10), number(11)]),
            }
        })
        .collect();
    assert_eq!(rows.len(), 2, "two materials in test {test}");
    rows
}

impl Row {
    fn restitution(&self) -> f64 {
        self.restitution.parse().unwrap()
    }

    fn grain(&self) -> Grain {
        Grain::sphere(self.radius * Vec3::z(), self.radius, self.density)
    }

    /// The law of a rigid plane.
    fn on_rigid(&self, restitution: f64) -> HertzLaw {
        HertzLaw::on_rigid(self.elastic, restitution).unwrap().with_friction(self.friction).unwrap()
    }
}

/// The grain after it has hit a floor, and the largest force and overlap, and the time between touch and zero force.
fn bounced(grain: Grain, law: HertzLaw, per_contact: f64) -> (Grain, [f64; 3]) {
    let duration = law.duration(grain.radius, grain.mass, -grain.velocity.z);
    let dt = duration / per_contact;
    let floor = Plane::fixed(Vec3::zeros(), Vec3::z(), law);
    let mut system = GrainSystem::new(GrainSetup::new(law), vec![grain], vec![floor]).unwrap();
    let mut seen = [0.0_f64; 3];
    while seen[2] < 3.0 * duration {
        system.substep(dt, &[]).unwrap();
        let force = system.contact_loads()[0].force.z;
        seen[0] = seen[0].max(force);
        seen[1] = seen[1].max(grain.radius - system.grains()[0].position.z);
        if force == 0.0 {
            break;
        }
        seen[2] += dt;
    }
    // Until it has left.
    for _ in 0..system_rest(per_contact) {
        system.substep(dt, &[]).unwrap();
    }
    (system.grains()[0], seen)
}

/// Half a contact more: a contact that has ended at zero force may still overlap.
fn system_rest(per_contact: f64) -> u32 {
    let half = 0.5 * per_contact;
    (0..).find(|&count| f64::from(count) >= half).unwrap()
}

/// Force, overlap and duration against Hertz's.
fn assert_hertz(name: &str, found: [f64; 3], hertz: [f64; 3]) {
    // Six digits are printed; the largest value lies half a sub-step from a sample at most, and is of second order in
    // it: (4/1000)²/8 = 2e-6, ten times that for what the scheme adds. Ends are seen to a sub-step each.
    for (what, at, tolerance) in
        [("force", 0, 3e-5), ("overlap", 1, 3e-5), ("duration", 2, 2.0 / FINE)]
    {
        let off = found[at] / hertz[at] - 1.0;
        assert!(off.abs() < tolerance, "{name}: largest {what} off Hertz's by {off:.1e}");
    }
}

#[test]
fn chung_and_ooi_1_two_elastic_spheres_meet_as_hertz_says() {
    for row in rows("1") {
        let law = HertzLaw::between([row.elastic; 2], 1.0).unwrap();
        let law = law.with_friction(row.friction).unwrap();
        let one = Grain { position: -row.radius * Vec3::x(), ..row.grain() };
        let one = one.moving(row.speed * Vec3::x());
        let two = Grain { position: -one.position, ..one.moving(-one.velocity) };
        let hertz = row.hertz.unwrap();
        let dt = hertz[2] / FINE;
        let mut system =
            GrainSystem::new(GrainSetup::new(law), vec![one, two], Vec::new()).unwrap();
        let mut seen = [0.0_f64; 3];
        for _ in 0..1500 {
            system.substep(dt, &[]).unwrap();
            let force = system.contact_loads()[1].force.x;
            seen[0] = seen[0].max(force);
            let distance = system.grains()[1].position.x - system.grains()[0].position.x;
            seen[1] = seen[1].max(2.0 * row.radius - distance);
            seen[2] += if force > 0.0 { dt } else { 0.0 };
        }
        assert_hertz(&row.material, seen, hertz);
        let rebound = system.grains()[1].velocity.x / row.speed;
        // As the largest values.
        assert!((rebound - 1.0).abs() < 3e-5, "{}: rebounds at {rebound}", row.material);
    }
}

#[test]
fn chung_and_ooi_2_an_elastic_sphere_meets_a_rigid_plane_as_hertz_says() {
    for row in rows("2") {
        let grain = row.grain().moving(-row.speed * Vec3::z());
        let (after, seen) = bounced(grain, row.on_rigid(1.0), FINE);
        assert_hertz(&row.material, seen, row.hertz.unwrap());
        let rebound = after.velocity.z / row.speed;
        assert!((rebound - 1.0).abs() < 3e-5, "{}: rebounds at {rebound}", row.material);
    }
}

#[test]
fn chung_and_ooi_3_spheres_leave_a_plane_with_the_restitution_asked_for() {
    for row in rows("3") {
        assert_eq!(&row.restitution, "0.2..1.0");
        for e in [0.2, 0.4, 0.6, 0.8, 1.0] {
            let grain = row.grain().moving(-row.speed * Vec3::z());
            let (after, _) = bounced(grain, row.on_rigid(e), FINE);
            // The dashpot starts as δ^(1/4): order 5/4, 1000^(-5/4) = 1.8e-4, and ten times that for its factor.
            let found = after.velocity.z / row.speed;
            assert!((found - e).abs() < 1.8e-3, "{}: leaves with {found}, not {e}", row.material);
        }
    }
}

fn at_angle(grain: Grain, degrees: f64, speed: f64) -> Grain {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    grain.moving(speed * Vec3::new(sine, 0.0, -cosine))
}

/// Velocity of the point of contact along x.
fn slip(grain: &Grain) -> f64 {
    grain.velocity.x - grain.angular_velocity.y * grain.radius
}

#[test]
fn chung_and_ooi_4_rebound_agrees_with_benchmark_and_experiment() {
    let row = &rows("4")[0];
    assert_eq!(row.material, "Al oxide");
    let law = row.on_rigid(row.restitution());
    let bounced = |degrees: f64| bounced(at_angle(row.grain(), degrees, row.speed), law, FINE).0;
    let table = golden_rows("dem/oblique_impact.csv");
    let mut points: Vec<(String, f64, f64)> = table
        .iter()
        .skip(1)
        .map(|row| (row[0].to_owned(), row[1].parse().unwrap(), row[2].parse().unwrap()))
        .collect();
    let curves = golden_rows("dem/chung_ooi_curves.csv");
    points.extend(
        curves
            .iter()
            .filter(|row| &row[0] == "4")
            .map(|row| (row[1].to_owned(), row[2].parse().unwrap(), row[3].parse().unwrap())),
    );
    let mut compared = 0;
    for (name, degrees, value) in points {
        // Below, the contact sticks to its end, and what becomes of the drawn spring as the overlap shrinks is each code's own
        // choice: benchmark and experiment are 0.2 apart there.
        if degrees < 9.0 {
            continue;
        }
        let after = bounced(degrees);
        // Two digitisations differ by 2 % of full scale, which is 1, 600 rad/s and 90 degrees. Where the contact sticks for
        // a part of the time (below 32 degrees) codes differ by as much again; and there the experiment has a rim that
        // slips, which no spring has: as much once more. The experiment's spins scatter by up to 8 %.
        let is_measured = name.contains("Kharaz");
        let sticks = match (degrees < 32.0, is_measured) {
            (true, true) => 0.06,
            (true, false) => 0.04,
            _ => 0.02,
        };
        let (found, scale, tolerance) = if name.starts_with("et") {
            (after.velocity.x / (row.speed * degrees.to_radians().sin()), 1.0, sticks)
        } else if name.starts_with("omega") {
            let scatter: f64 = if is_measured { 0.08 } else { sticks };
            (-after.angular_velocity.y, 600.0, scatter)
        } else {
            let angle = (slip(&after) / after.velocity.z).atan().to_degrees();
            // Of the experiment it is worked out from the spin, 8 % of which are 1.6 degrees at 60 degrees.
            (angle, 90.0, if is_measured { sticks.max(0.04) } else { sticks })
        };
        assert!(
            (found - value).abs() < tolerance * scale,
            "test 4, {name} at {degrees} degrees: computed {found:.4}, published {value}"
        );
        compared += 1;
    }
    assert!(compared >= 60, "only {compared} published values were compared");
}

#[test]
fn chung_and_ooi_4_and_5_gross_sliding_has_the_exact_impulse() {
    // μ (1 + e) v_n along the plane, 2.5 times that over R in angular velocity: 4 for both materials at angles beyond
    // 34 degrees, 5 for v_t/(μ v_n) beyond 7.
    let (four, five) = (rows("4"), rows("5"));
    let steep = [34.0, 50.0, 70.0, 85.0_f64].map(|degrees| degrees.to_radians());
    let impacts = four
        .iter()
        .flat_map(|row| steep.map(|angle| (row, angle.sin() * row.speed, angle.cos() * row.speed)));
    let fast = [7.5, 10.0, 20.0];
    let fives = five
        .iter()
        .flat_map(|row| fast.map(|ratio| (row, ratio * row.friction * row.speed, row.speed)));
    for (row, along, normal) in impacts.chain(fives) {
        let e = row.restitution();
        let grain = row.grain().moving(Vec3::new(along, 0.0, -normal));
        let (after, seen) = bounced(grain, row.on_rigid(e), FINE);
        let given = row.friction * (1.0 + e) * normal;
        // Slides from the first sub-step, in which the dashpots still act, to the last: an impulse of 1e-3 each way; and as
        // wrong as e (test 3).
        let off = (along - after.velocity.x) / given - 1.0;
        assert!(off.abs() < 3e-3, "{}: tangential impulse off by {off:.1e}", row.material);
        // The arm is shorter by the overlap, at most.
        let off = after.angular_velocity.y * row.radius / (2.5 * given) - 1.0;
        let arm = seen[1] / row.radius;
        assert!(off.abs() < arm + 3e-3, "{}: angular impulse off by {off:.1e}", row.material);
    }
}

#[test]
fn chung_and_ooi_5_the_curves_of_sliding_are_met() {
    let row = &rows("5")[0];
    assert_eq!(row.material, "steel");
    let curves = golden_rows("dem/chung_ooi_curves.csv");
    let mut compared = 0;
    for point in curves.iter().filter(|point| &point[0] == "5") {
        let (x, y): (f64, f64) = (point[2].parse().unwrap(), point[3].parse().unwrap());
        // Of the curves only what slides to its end can be compared. Below x = 5 they are those of another
        // tangential spring: there the surface comes back with -0.75 of its speed from the smallest angles on, which
        // the curves of test 4, at nearly the same Poisson's ratio, contradict.
        if x < 5.9 {
            continue;
        }
        let normal = row.speed;
        let grain = row.grain().moving(Vec3::new(x * row.friction * normal, 0.0, -normal));
        let (after, _) = bounced(grain, row.on_rigid(1.0), FINE);
        let unit = row.friction * normal;
        let found = match point[1].contains("angvel") {
            true => -after.angular_velocity.y * row.radius / unit,
            false => slip(&after) / unit,
        };
        // Digitised to 2 % of a full scale of 10.
        assert!((found - y).abs() < 0.2, "test 5 at {x}: computed {found:.3}, published {y}");
        compared += 1;
    }
    assert!(compared >= 6, "only {compared} published values were compared");
}

#[test]
fn chung_and_ooi_6_spinning_spheres_take_the_impulse_of_sliding_or_stick() {
    for row in rows("6") {
        let e = row.restitution();
        let most = row.friction * (1.0 + e) * row.speed;
        for omega in [0.175, 1.0, 2.0, 6.0, 12.0, 24.0] {
            let grain = row.grain().moving(-row.speed * Vec3::z()).spinning(omega * Vec3::y());
            let (after, seen) = bounced(grain, row.on_rigid(e), FINE);
            // Force and torque are one force at one point: Δω = -2.5 Δv/R, but for the overlap in the arm.
            let turned = (omega - after.angular_velocity.y) * row.radius / (2.5 * after.velocity.x);
            let arm = seen[1] / row.radius;
            assert!(
                turned < 1.0 + 1e-9 && turned > 1.0 - arm,
                "{}, {omega} rad/s: angular over linear impulse {turned}",
                row.material
            );
            // Of 3.5 μ (1 + e) v_n = 0.42 m/s, 4.2 rad/s, and more, with a margin for swinging back: slides to the end.
            let share = after.velocity.x / most;
            match omega {
                6.0.. => assert!(
                    (share - 1.0).abs() < 3e-3,
                    "{}, {omega} rad/s: {share} of the impulse of sliding",
                    row.material
                ),
                _ => assert!(
                    share > 0.0 && share < 1.0,
                    "{}, {omega} rad/s: {share} of the impulse of sliding",
                    row.material
                ),
            }
        }
    }
}

#[test]
fn chung_and_ooi_7_equal_spins_of_two_spheres_roll_off_each_other_unchanged() {
    // Equal in size and opposed in sense, as two gears: the surfaces meet without sliding.
    for row in rows("7") {
        let e = row.restitution();
        let law = HertzLaw::between([row.elastic; 2], e).unwrap();
        let law = law.with_friction(row.friction).unwrap();
        for omega in [0.175, 5.0, 24.0] {
            let spin = omega * Vec3::y();
            let one = Grain { position: -row.radius * Vec3::x(), ..row.grain() }
                .moving(row.speed * Vec3::x())
                .spinning(spin);
            let two =
                Grain { position: -one.position, ..one.moving(-one.velocity).spinning(-spin) };
            let duration = law.duration(0.5 * row.radius, 0.5 * one.mass, 2.0 * row.speed);
            let mut system =
                GrainSystem::new(GrainSetup::new(law), vec![one, two], Vec::new()).unwrap();
            for _ in 0..2000 {
                system.substep(duration / FINE, &[]).unwrap();
            }
            for (grain, sign) in system.grains().iter().zip([-1.0, 1.0]) {
                assert_eq!(grain.angular_velocity, -sign * spin, "nothing turns them");
                assert_eq!((grain.velocity.y, grain.velocity.z), (0.0, 0.0));
                let found = sign * grain.velocity.x / row.speed;
                // As test 3.
                assert!((found - e).abs() < 1.8e-3, "{}: leaves with {found}", row.material);
            }
        }
    }
}

#[test]
fn chung_and_ooi_8_a_spinning_sphere_takes_the_impulse_of_sliding_from_a_much_heavier_one() {
    for row in rows("8") {
        let e = row.restitution();
        let same = row.elastic;
        let stiff = Elastic { youngs_modulus: 1000.0 * same.youngs_modulus, ..same };
        for other in [stiff, same] {
            let law = HertzLaw::between([row.elastic, other], e).unwrap();
            let law = law.with_friction(row.friction).unwrap();
            let large = Grain::sphere(-0.5 * Vec3::z(), 0.5, 1000.0 * row.density);
            let small = row.grain().moving(-row.speed * Vec3::z()).spinning(24.0 * Vec3::y());
            let radius = 0.5 * row.radius / (0.5 + row.radius);
            let mass = small.mass * large.mass / (small.mass + large.mass);
            let duration = law.duration(radius, mass, row.speed);
            let mut system =
                GrainSystem::new(GrainSetup::new(law), vec![small, large], Vec::new()).unwrap();
            for _ in 0..2000 {
                system.substep(duration / FINE, &[]).unwrap();
            }
            let [small_after, large_after] = [system.grains()[0], system.grains()[1]];
            // The heavy one has 125,000 times the mass: its share of all this is below 1e-4.
            let rebound = small_after.velocity.z / row.speed;
            assert!((rebound - e).abs() < 2e-3, "{}: rebounds with {rebound}", row.material);
            let given = row.friction * (1.0 + e) * row.speed;
            // The line of centres turns by what the small one moves along in the contact, some 1e-4 of its radius.
            let off = small_after.velocity.x / given - 1.0;
            assert!(off.abs() < 4e-3, "{}: tangential impulse off by {off:.1e}", row.material);
            let turned = (24.0 - small_after.angular_velocity.y) * row.radius;
            let off = turned / (2.5 * given) - 1.0;
            assert!(off.abs() < 4e-3, "{}: angular impulse off by {off:.1e}", row.material);
            // Momentum, to round-off of the heavy one's.
            let before = small.mass * small.velocity;
            let after =
                small_after.mass * small_after.velocity + large_after.mass * large_after.velocity;
            let lost = (after - before).norm() / before.norm();
            assert!(lost < 1e-10, "{}: momentum off by {lost:.1e}", row.material);
        }
    }
}
