//! The page: what a reader must find on it, on a screen, a phone and paper.

use psmrt_report::{
    Agreement, Axis, DataTable, Figure, Found, Headline, Link, Page, Picture, Section, Series,
    Verdict, render_page,
};

fn link(text: &str, href: &str) -> Link {
    Link { text: text.to_owned(), href: href.to_owned() }
}

fn verdict(holds: bool) -> Verdict {
    Verdict {
        claim: "order of the error".to_owned(),
        found: vec![Found {
            by: "cpu".to_owned(),
            measured: "1.97".to_owned(),
            holds,
            history: vec![1.9, 1.95, 1.97],
        }],
        allowed: "1.8 to 2.1".to_owned(),
        why: "second order".to_owned(),
    }
}

fn page() -> Page {
    let figure = Figure::new("Profile", Axis::linear("x"), Axis::linear("u"))
        .with(Series::line("a", vec![(0.0, 1.0), (1.0, 2.0)]));
    Page {
        title: "report".to_owned(),
        sections: vec![Section {
            name: "duct".to_owned(),
            title: "Flow in a duct".to_owned(),
            about: vec!["A <flow>.".to_owned(), "By a force.".to_owned()],
            picture: None,
            film: None,
            verdicts: vec![verdict(true)],
            figures: vec![figure.clone(), figure],
            tables: vec![DataTable {
                caption: "What was measured".to_owned(),
                columns: vec!["cells".to_owned()],
                rows: vec![vec!["4.2e-2".to_owned()], vec!["two words".to_owned()]],
            }],
            scenes: vec![link("golden/duct/scene.toml", "data/duct/scene.toml")],
            data: vec![link("duct.csv", "duct.csv"), link("duct_1.svg", "duct_1.svg")],
            command: "cargo validate report --case duct".to_owned(),
            full: "none".to_owned(),
        }],
        environment: vec![("made on".to_owned(), "2026-11-22 (UTC)".to_owned())],
        ..Page::default()
    }
}

#[test]
fn scenes_and_data_are_links_and_what_there_is_none_of_is_called_so() {
    let html = render_page(&page()).unwrap();
    for (text, href) in [
        ("golden/duct/scene.toml", "data/duct/scene.toml"),
        ("duct.csv", "duct.csv"),
        ("duct_1.svg", "duct_1.svg"),
    ] {
        let link = format!("<a href=\"{href}\"><code>{text}</code></a>");
        assert!(html.contains(&link), "{link}");
    }
    let mut without = page();
    without.sections[0].scenes.clear();
    assert!(render_page(&without).unwrap().contains("Scenes: none."));
}

#[test]
fn a_page_needs_no_other_file_to_be_read() {
    let html = render_page(&page()).unwrap();
    assert!(html.contains("<svg") && html.contains("<style>"));
    // What it shows and runs is in it.
    for needs in ["src=\"http", "src=\"/", "<script src", "<link", "@import", "url("] {
        assert!(!html.contains(needs), "{needs}");
    }
    assert!(html.contains("A &lt;flow&gt;."), "words are not obeyed as HTML");
}

#[test]
fn a_page_opens_with_the_numbers_that_matter_and_a_picture() {
    let mut page = page();
    page.lead = "It is held to exact solutions.".to_owned();
    page.headlines = vec![Headline {
        quantity: "mean velocity".to_owned(),
        reference: "0.0351".to_owned(),
        source: "series".to_owned(),
        found: "0.0350 (16 cells)".to_owned(),
        error: "-0.05 %".to_owned(),
        uncertainty: "0.06 %".to_owned(),
        is_within: Some(true),
        case: "duct".to_owned(),
    }];
    page.picture = Some(Picture { png_base64: "AAAA".to_owned(), caption: "grains".to_owned() });
    let html = render_page(&page).unwrap();
    let place = |text: &str| html.find(text).unwrap_or_else(|| panic!("no {text}"));
    let order = [
        place("It is held to exact solutions."),
        place("<a href=\"#duct\">mean velocity</a>"),
        place("data:image/png;base64,AAAA"),
        place("<nav>"),
        place("<h2>Flow in a duct</h2>"),
        place("id=\"verdicts\""),
    ];
    assert!(order.is_sorted(), "{order:?}");
}

#[test]
fn a_case_shows_its_first_figure_and_folds_the_rest_unless_a_claim_fails() {
    let mut page = page();
    let html = render_page(&page).unwrap();
    let section = &html[html.find("<section id=\"duct\">").unwrap()..];
    assert!(
        section.find("<svg").unwrap() < section.find("<details").unwrap(),
        "the figure comes first"
    );
    assert!(section.contains("<details><summary>One more figure</summary>"));
    assert!(
        section.contains("<details><summary>1 of 1 claims hold"),
        "claims that hold are folded"
    );
    page.sections[0].verdicts.push(verdict(false));
    let html = render_page(&page).unwrap();
    assert!(
        html.contains("<details open><summary>1 of 2 claims hold"),
        "a claim that fails is not"
    );
}

#[test]
fn every_claim_leads_to_its_reasons_and_has_its_history() {
    let html = render_page(&page()).unwrap();
    assert!(html.contains("<a href=\"#duct-1\">order of the error</a>"));
    assert!(html.contains("<tr id=\"duct-1\">"));
    assert!(html.contains("<title>3 reports, from 1.9000e0 to 1.9700e0</title>"));
}

#[test]
fn the_environment_is_a_table_whose_names_are_headings() {
    let html = render_page(&page()).unwrap();
    assert!(html.contains("<tr><th scope=\"row\">made on</th><td>2026-11-22 (UTC)</td></tr>"));
}

#[test]
fn a_claim_that_fails_is_told_by_words_and_not_by_colour_alone() {
    let mut page = page();
    assert!(page.holds() && render_page(&page).unwrap().contains("1 of 1 claims hold: 1 are"));
    page.sections[0].verdicts.push(verdict(false));
    let html = render_page(&page).unwrap();
    assert!(
        !page.holds() && html.contains("✗ FAILS") && html.contains("1 of 2 claims hold: 2 are")
    );
    page.sections[0].verdicts.clear();
    assert!(!page.holds(), "a case without a claim shows nothing");
}

/// The rules for a medium: from `head` to the brace that closes it.
fn rules<'a>(html: &'a str, head: &str) -> &'a str {
    let from = html.find(head).unwrap_or_else(|| panic!("no {head}"));
    let rules = &html[from..];
    &rules[..rules.find("\n}").unwrap()]
}

#[test]
fn on_a_phone_claims_are_cards_whose_numbers_have_names() {
    let html = render_page(&page()).unwrap();
    let phone = rules(&html, "@media screen and (max-width: 40rem)");
    // Without the head of the table its columns are named in front of the numbers.
    assert!(phone.contains(".claims thead { display: none; }"));
    for name in ["measured", "allowed"] {
        assert!(phone.contains(&format!(".claims .{name}::before {{ content: \"{name} \"")));
        // In both tables, of all claims and of the case.
        assert_eq!(html.matches(&format!("<td class=\"{name}\">")).count(), 2);
    }
    assert_eq!(html.matches("<table class=\"claims\"").count(), 2);
}

#[test]
fn folded_tables_are_printed_and_figures_keep_their_size_on_small_screens() {
    let html = render_page(&page()).unwrap();
    // Chromium folds `details` by `content-visibility`, which no `display` undoes.
    let print = rules(&html, "@media print");
    assert!(print.contains("details::details-content { content-visibility: visible; }"));
    assert!(print.contains("figure svg { min-width: 0; }"));
    assert!(html.contains("figure { margin: 1rem 0; overflow-x: auto; }"));
    // A number is never broken at the minus sign of its exponent.
    assert!(
        html.contains("<td class=\"number\">4.2e-2</td>") && html.contains("<td>two words</td>")
    );
    assert!(html.contains("<details><summary>What was measured</summary>"));
}

#[test]
fn a_case_shows_its_picture_before_its_figures_and_its_film_beside_the_page() {
    let mut page = page();
    let section = &mut page.sections[0];
    let caption = "A fall".to_owned();
    section.picture = Some(Picture { png_base64: "iVBORw0KGgo=".to_owned(), caption });
    section.film = Some(link("The film", "data/duct/film.webm"));
    let html = render_page(&page).unwrap();
    let picture = html.find("data:image/png;base64,iVBORw0KGgo=").expect("the picture");
    assert!(picture < html.find("<figure><svg").expect("a figure"), "the picture comes first");
    // Nothing of it is loaded before a reader asks for it.
    assert!(html.contains("<video controls preload=\"none\" src=\"data/duct/film.webm\">"));
}

#[test]
fn a_page_says_how_far_off_it_is_by_quantity_between_the_contents_and_the_cases() {
    let mut page = page();
    let row = ["drag", "3", "+1.0 %", "2.0 %"].map(str::to_owned).to_vec();
    page.agreement = Some(Agreement {
        about: vec!["Over all cases.".to_owned()],
        table: DataTable { caption: String::new(), columns: Vec::new(), rows: vec![row] },
        figures: page.sections[0].figures.clone(),
    });
    let html = render_page(&page).unwrap();
    let place = html.find("<section id=\"agreement\">").expect("the section");
    let case = html.find("<section id=\"duct\">").expect("the case");
    assert!(html.find("<nav>").unwrap() < place && place < case);
    let own = &html[place..case];
    assert!(own.contains("+1.0 %") && own.contains("href=\"agreement.csv\""), "{own}");
    assert_eq!(own.matches("<svg").count(), 2, "the second figure is folded, and there");
    assert!(own.find("<svg").unwrap() < own.find("<details>").unwrap());
}
