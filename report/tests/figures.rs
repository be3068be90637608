//! What a figure promises: that it shows what it was given, and refuses the rest by name.

use psmrt_report::{Axis, Figure, Marker, PlotError, PowerLaw, Series, Style, render_svg};

fn linear() -> Figure {
    Figure::new("t", Axis::linear("x (m)"), Axis::linear("y (s)"))
}

fn log_log() -> Figure {
    Figure::new("t", Axis::log("N (-)"), Axis::log("error (-)"))
}

fn svg(figure: &Figure) -> String {
    render_svg(figure).unwrap()
}

fn refusal(figure: &Figure) -> String {
    render_svg(figure).unwrap_err().to_string()
}

/// The texts of an SVG, in drawing order, as they stand between the tags.
fn texts(svg: &str) -> Vec<&str> {
    svg.split("<text").skip(1).filter_map(text_of).collect()
}

fn text_of(element: &str) -> Option<&str> {
    let (_, rest) = element.split_once('>')?;
    Some(rest.split_once("</text>")?.0.trim())
}

/// A profile of 21 points from 0 to 1.
fn parabola() -> Vec<(f64, f64)> {
    (0..=20).map(f64::from).map(|i| (i / 20.0, i / 20.0 * (1.0 - i / 20.0))).collect()
}

#[test]
fn title_labels_legend_and_notes_are_in_the_picture() {
    let figure = Figure::new("Poiseuille flow", Axis::linear("y/H (-)"), Axis::linear("u (m/s)"))
        .with(Series::line("exact", parabola()))
        .with(Series::points("MRT", parabola()))
        .note("16 cells");
    let svg = svg(&figure);
    let texts = texts(&svg);
    for text in ["Poiseuille flow", "y/H (-)", "u (m/s)", "exact", "MRT", "16 cells"] {
        assert!(texts.contains(&text), "{text} is not among {texts:?}");
    }
    assert!(svg.contains("sans-serif"));
    assert!(svg.starts_with("<svg width=\"800\" height=\"535\""), "{}", &svg[..60]);
    assert!(svg.trim_end().ends_with("</svg>"));
}

#[test]
fn letters_that_mean_something_in_xml_are_escaped() {
    let figure = linear().with(Series::line("Re < 1 & \"slow\"\u{0}", parabola()));
    let svg = svg(&figure);
    assert!(texts(&svg).contains(&"Re &lt; 1 &amp; &quot;slow&quot;"));
    assert!(!svg.contains('\u{0}'));
}

#[test]
fn the_same_figure_gives_the_same_bytes() {
    let figure = log_log().with(Series::line_points("a", vec![(8.0, 0.1), (16.0, 0.025)]));
    assert_eq!(svg(&figure), svg(&figure.clone()));
}

#[test]
fn ticks_have_no_float_noise() {
    let figure = linear().with(Series::line("a", vec![(0.0, -0.3), (0.7, 0.1 + 0.2)]));
    let svg = svg(&figure);
    let texts = texts(&svg);
    assert!(texts.contains(&"0.3") && texts.contains(&"-0.1"), "{texts:?}");
    assert!(texts.iter().all(|text| text.len() < 6), "{texts:?}");
}

#[test]
fn chosen_ticks_have_no_float_noise() {
    let axis = Axis::linear("x (m)").ticks(&[0.6, 0.1 + 0.2]);
    let figure = Figure::new("t", axis, Axis::linear("y (s)"));
    let svg = svg(&figure.with(Series::line("a", vec![(0.0, 0.0), (1.0, 1.0)])));
    let texts = texts(&svg);
    assert!(texts.contains(&"0.3") && texts.contains(&"0.6"), "{texts:?}");
}

#[test]
fn log_ticks_are_powers_of_ten_over_decades_and_multiples_within_one() {
    let decades = log_log().with(Series::points("a", vec![(1.0, 1e-6), (1e3, 1.0)]));
    let decades = svg(&decades);
    for tick in ["1", "10", "100", "1000", "1e-6", "1e-3"] {
        assert!(texts(&decades).contains(&tick), "{tick}: {:?}", texts(&decades));
    }
    let one = svg(&log_log().with(Series::points("a", vec![(8.0, 3.1), (80.0, 3.3)])));
    for tick in ["10", "20", "50", "3.10", "3.20", "3.30"] {
        assert!(texts(&one).contains(&tick), "{tick}: {:?}", texts(&one));
    }
}

#[test]
fn values_that_are_all_equal_get_a_padded_range() {
    for figure in [linear(), log_log()] {
        let svg = svg(&figure.with(Series::points("a", vec![(2.0, 5.0), (2.0, 5.0)])));
        assert!(texts(&svg).iter().any(|text| ["2", "2.00"].contains(text)), "{:?}", texts(&svg));
    }
    svg(&linear().with(Series::points("zero", vec![(0.0, 0.0)])));
}

#[test]
fn a_non_positive_value_on_a_log_axis_is_an_error_that_names_it() {
    let points = vec![(8.0, 0.1), (16.0, -0.02)];
    let told = refusal(&log_log().with(Series::points("drag", points)));
    assert_eq!(
        told,
        "series \"drag\": y = -0.02 at point 2 has no place on the log axis \"error (-)\"; \
         leave the point out, or use a linear axis"
    );
    let told = refusal(&log_log().with(Series::points("drag", vec![(0.0, 1.0)])));
    assert!(told.contains("x = 0.0 at point 1") && told.contains("N (-)"), "{told}");
}

#[test]
fn a_value_that_is_not_finite_is_an_error_that_names_it() {
    for (value, word) in [(f64::NAN, "NaN"), (f64::INFINITY, "inf")] {
        let told = refusal(&linear().with(Series::line("mass", vec![(0.0, 1.0), (1.0, value)])));
        assert!(told.contains("\"mass\"") && told.contains("point 2"), "{told}");
        assert!(told.contains(&format!("y = {word}")), "{told}");
    }
    let told = refusal(&linear().with(Series::line("", vec![(f64::NAN, 1.0)])));
    assert!(told.contains("number 1 (without a label)"), "{told}");
}

#[test]
fn an_empty_series_or_figure_is_an_error_that_names_it() {
    assert!(refusal(&linear().with(Series::line("bed", vec![]))).contains("\"bed\" has no points"));
    assert!(refusal(&linear()).contains("panel 1 has no series"));
    let second = linear().with(Series::line("a", parabola())).with_panel(Axis::linear("r"));
    assert!(refusal(&second).contains("panel 2 has no series"));
}

#[test]
fn errors_must_be_one_a_point_and_not_negative() {
    let series = Series::points("C_D", vec![(1.0, 2.0), (2.0, 3.0)]);
    let few = refusal(&linear().with(series.clone().with_errors(vec![0.1])));
    assert!(few.contains("\"C_D\" has 2 points but 1 errors"), "{few}");
    let negative = refusal(&linear().with(series.with_errors(vec![0.1, -0.1])));
    assert!(negative.contains("point 2 is -0.1"), "{negative}");
}

#[test]
fn a_range_that_the_axis_cannot_show_is_an_error_that_names_it() {
    let with = |x: Axis| {
        let figure = Figure::new("t", x, Axis::linear("y"));
        refusal(&figure.with(Series::line("a", vec![(1.0, 1.0), (2.0, 2.0)])))
    };
    assert!(with(Axis::linear("x").range(2.0, 1.0)).contains("the range 2.0 to 1.0 is empty"));
    assert!(with(Axis::log("tau").range(0.0, 1.0)).contains("axis \"tau\""));
    assert!(with(Axis::linear("x").range(0.0, f64::NAN)).contains("not finite"));
    assert!(with(Axis::linear("x").range(1.0, 1.0 + 1e-15)).contains("too narrow"));
    assert!(with(Axis::log("x").ticks(&[1.0, 0.0])).contains("a tick at 0.0"));
}

#[test]
fn points_outside_the_range_are_counted_under_the_figure() {
    let axis = Axis::linear("x (m)").range(0.0, 1.0);
    let points = vec![(0.5, 1.0), (2.0, 2.0), (3.0, 3.0)];
    let figure = Figure::new("t", axis, Axis::linear("y (s)")).with(Series::points("a", points));
    assert!(texts(&svg(&figure)).contains(&"a: 2 of 3 points lie outside the axes."));
}

#[test]
fn an_error_bar_that_reaches_zero_on_a_log_axis_ends_at_the_frame_and_says_so() {
    let series = Series::points("a", vec![(1.0, 2.0), (2.0, 3.0)]).with_errors(vec![3.0, 1.0]);
    let svg = svg(&log_log().with(series));
    assert!(texts(&svg).contains(&"a: error bars that reach zero or less end at the frame."));
}

#[test]
fn nothing_is_drawn_outside_the_picture() {
    let axis = Axis::linear("x (m)").range(0.0, 1.0);
    let steep = (0..100).map(f64::from).map(|i| (i / 50.0 - 0.5, (i / 3.0).exp())).collect();
    let figure = Figure::new("t", axis, Axis::linear("y (s)").range(0.0, 10.0));
    let svg = svg(&figure.with(Series::line("a", steep)));
    let points = svg.split("points=\"").skip(1).filter_map(|part| part.split_once('"'));
    for pair in points.flat_map(|(points, _)| points.split_whitespace()) {
        let (x, y) = pair.split_once(',').unwrap();
        let (x, y): (i32, i32) = (x.parse().unwrap(), y.parse().unwrap());
        assert!((0..=8000).contains(&x) && (0..=5200).contains(&y), "{x},{y}");
    }
}

#[test]
fn a_panel_of_residuals_shares_colours_and_the_legend() {
    let figure = linear()
        .with(Series::line("exact", parabola()))
        .with(Series::points("MRT", parabola()))
        .with_panel(Axis::linear("residual (s)"))
        .with(Series::points("MRT", parabola()));
    let svg = svg(&figure);
    let texts = texts(&svg);
    assert_eq!(texts.iter().filter(|text| **text == "MRT").count(), 1);
    assert_eq!(texts.iter().filter(|text| **text == "x (m)").count(), 1);
    assert!(texts.contains(&"residual (s)"));
    // 21 squares a panel and one in the legend, all in the second colour.
    let squares = svg.matches("<polygon opacity=\"1\" fill=\"#D55E00\"").count();
    assert_eq!(squares, 2 * 21 + 1);
}

#[test]
fn a_legend_that_would_cover_data_stands_outside() {
    let full: Vec<_> = (0..400).map(f64::from).map(|i| (i % 20.0, (i / 20.0).floor())).collect();
    let svg = svg(&linear().with(Series::points("everywhere", full)));
    let (before, _) = svg.split_once("\neverywhere").unwrap();
    let (_, x) = before.rsplit_once("<text x=\"").unwrap();
    let x: i32 = x.split_once('"').unwrap().0.parse().unwrap();
    let right = svg.split("cx=\"").skip(1).filter_map(|c| c.split_once('"'));
    let inside = right.map(|(cx, _)| cx.parse::<i32>().unwrap()).filter(|cx| *cx < x - 500);
    assert!(inside.count() >= 400);
}

#[test]
fn a_fit_finds_the_order_and_a_reference_line_has_its_slope() {
    let points: Vec<_> = [8.0, 16.0, 32.0].map(|n: f64| (n, 3.0 * n.powf(-2.0))).to_vec();
    let fit = PowerLaw::fit(&points).unwrap();
    assert!((fit.order + 2.0).abs() < 1e-12);
    assert!((fit.at(16.0) / points[1].1 - 1.0).abs() < 1e-12);

    let slope = Series::reference_slope("order 2", -2.0, (10.0, 0.1), (10.0, 100.0));
    let (first, last) = (slope.points[0], slope.points[slope.points.len() - 1]);
    assert_eq!(first, (10.0, 0.1));
    assert!((last.0 - 100.0).abs() < 1e-9 && (last.1 - 0.001).abs() < 1e-12);
    assert_eq!(slope.style, Style::Reference);
    svg(&log_log().with(Series::points("a", points)).with(slope));
}

#[test]
fn a_fit_through_too_few_or_bad_points_is_refused() {
    assert!(matches!(PowerLaw::fit(&[]), Err(PlotError::NoFit(_))));
    assert!(matches!(PowerLaw::fit(&[(8.0, 1.0), (8.0, 2.0)]), Err(PlotError::NoFit(_))));
    let told = PowerLaw::fit(&[(8.0, 1.0), (16.0, 0.0)]).unwrap_err().to_string();
    assert!(told.contains("point 2 is (16.0, 0.0)"), "{told}");
    let bad = Series::reference_slope("order 1", 1.0, (1.0, 1.0), (0.0, 1.0));
    assert!(refusal(&log_log().with(bad)).contains("\"order 1\""));
}

#[test]
fn seven_series_differ_without_colour() {
    let points = |k: f64| vec![(0.0, k), (1.0, k + 1.0)];
    let mut figure = linear();
    for k in 0..7 {
        figure = figure.with(Series::points(format!("s{k}"), points(f64::from(k))));
    }
    let svg = svg(&figure);
    for colour in ["0072B2", "D55E00", "009E73", "CC79A7", "E69F00", "56B4E9", "000000"] {
        assert!(svg.contains(colour), "{colour}");
    }
    let round = svg.matches("<circle").count();
    // Disc: rim and disc. Ring: rim, disc, hole. Two points each, and one in the legend.
    assert_eq!(round, 3 * 2 + 3 * 3);
}

#[test]
fn a_line_with_one_point_is_visible() {
    let svg = svg(&linear().with(Series::line("one", vec![(1.0, 1.0)])));
    assert!(svg.contains("<circle"));
}

#[test]
fn a_size_without_room_is_an_error() {
    let told = refusal(&linear().with(Series::line("a", parabola())).size(100, 60));
    assert!(told.contains("100 x 60"), "{told}");
    let told = refusal(&linear().with(Series::line("a", parabola())).size(u32::MAX, 600));
    assert!(told.contains("at most 20000"), "{told}");
}

#[test]
fn extreme_values_are_drawn_or_refused_without_a_panic() {
    let values = [f64::MIN, -1.0, -5e-324, 0.0, 5e-324, 1.0, 1.0 + 1e-15, 1e15, 1e300, f64::MAX];
    let styles = [Style::Line, Style::LinePoints(Some(Marker::Cross)), Style::Reference];
    let mut drawn = 0;
    for (a, b, style) in values
        .iter()
        .flat_map(|a| values.iter().flat_map(move |b| styles.map(|style| (*a, *b, style))))
    {
        let points = vec![(a, b), (b, a), (1.0, 1.0)];
        let series = Series::new("a", style, points).with_errors(vec![1.0; 3]);
        for figure in [linear(), log_log()] {
            if let Ok(svg) = render_svg(&figure.with(series.clone())) {
                assert!(!svg.contains("NaN") && !svg.contains("inf"), "{a:?} {b:?} {style:?}");
                drawn += 1;
            }
        }
    }
    assert!(drawn > 200, "{drawn}");
}

#[test]
fn a_path_that_cannot_be_written_is_an_error_that_names_it() {
    let figure = linear().with(Series::line("a", parabola()));
    let told =
        |path: &std::path::Path| psmrt_report::write_svg(&figure, path).unwrap_err().to_string();
    let temp = std::env::temp_dir();
    let missing = temp.join(format!("psmrt-report-{}", std::process::id())).join("a.svg");
    assert!(told(&missing).contains("does not exist; create it first"), "{}", told(&missing));
    assert!(told(&missing).contains("a.svg"));
    assert!(told(&temp.join("a.png")).contains("let the name end in .svg"));
}

#[test]
fn a_map_is_drawn_with_its_scale_and_grey_where_there_is_no_value() {
    let map = psmrt_report::Map {
        title: "Speed".into(),
        x: Axis::linear("x (mm)").range(0.0, 3.0),
        y: Axis::linear("y (mm)").range(0.0, 2.0),
        value: Axis::linear("speed (mm/s)").range(0.0, 4.0),
        columns: 3,
        circles: vec![[0.0, 1.0, 0.7]],
        values: vec![Some(0.0), Some(1.0), Some(2.0), None, Some(4.0), Some(4.0)],
        note: "after 3 s".into(),
    };
    let svg = psmrt_report::render_map(&map).unwrap();
    for text in ["Speed", "x (mm)", "y (mm)", "speed (mm/s)", "after 3 s"] {
        assert!(texts(&svg).contains(&text), "{text}");
    }
    assert_eq!(svg.matches("#999999").count(), 1);
    // The two light cells are one piece; the scale has the same colour at its end.
    assert_eq!(svg.matches("#FDE725").count(), 2);
    let refusal = |map| psmrt_report::render_map(&map).unwrap_err().to_string();
    let ragged = psmrt_report::Map { columns: 4, ..map.clone() };
    assert!(refusal(ragged).contains("6 values do not fill rows of 4"));
    let broken = psmrt_report::Map { values: vec![Some(f64::NAN); 3], ..map };
    assert!(refusal(broken).contains("not finite"));
}
