//! A picture never shows work from nothing: an unloading that its law puts above the loading is named and not
//! drawn, and a chart without a point is none.

use asperity::rough::charts::travel_chart;
use asperity::roughness::Closure;

#[test]
fn an_unloading_above_its_loading_is_named_and_not_drawn() {
    let loading = vec![[0.0, 0.0], [1.0, 1.0], [2.0, 4.0]];
    let below = vec![[2.0, 4.0], [1.5, 1.0], [1.2, 0.0]];
    // at 1.5 the loading carries 2.5; a hair above it is the width of a line
    let above = vec![[2.0, 4.0], [1.5, 2.6], [1.2, 0.0]];
    let hair = vec![[2.0, 4.0], [1.5, 2.53], [1.2, 0.0]];
    for (unloading, lines) in [(below, 2), (above, 1), (hair, 2)] {
        let chart = travel_chart([(Closure::Calibrated, [loading.clone(), unloading.clone()])]);
        assert_eq!(chart.series.len(), lines, "{unloading:?}");
        assert_eq!(chart.title.contains("not drawn: the unloading of calibrated"), lines == 1);
    }
}

#[test]
fn a_chart_of_no_contact_is_empty() {
    assert!(travel_chart([(Closure::Johnson, [Vec::new(), Vec::new()])]).is_empty());
    assert!(travel_chart([]).is_empty());
}
