//! Side view of the vehicle with labelled axles, bodies and dampers.

use dashpot_live::{Outline, wheelbase};
use dashpot_rail::vehicle::{Body, Direction, Law, VehicleParameters};
use maud::{Markup, html};

/// Pixels per metre.
const SCALE: f64 = 44.0;
const MARGIN: f64 = 30.0;
/// Height of the sheet above the rails, m.
const SKY_M: f64 = 4.4;

/// Conversion from metres (forward is to the right) to pixels.
struct Sheet {
    rear_m: f64,
    width: f64,
    height: f64,
}

impl Sheet {
    fn x(&self, x_m: f64) -> f64 {
        MARGIN + SCALE * (x_m - self.rear_m)
    }

    fn y(&self, height_m: f64) -> f64 {
        SCALE * (SKY_M - height_m)
    }
}

/// Draws the vehicle from its right side, running to the right.
pub(super) fn vehicle(parameters: &VehicleParameters) -> Markup {
    let [rear, front] = wheelbase(parameters);
    let sheet = Sheet {
        rear_m: rear - 2.2,
        width: SCALE * (front - rear + 4.4) + 2.0 * MARGIN,
        height: SCALE * (SKY_M + 1.2),
    };
    let body_outline = |body: &Body| {
        let Outline {
            x_m: [from, to],
            height_m: [bottom, top],
            is_frame,
        } = Outline::of(parameters, body);
        let size = [SCALE * (to - from), SCALE * (top - bottom)];
        ([sheet.x(from), sheet.y(top)], size, is_frame)
    };
    html! {
        svg.drawing viewBox=(format!("0 0 {:.0} {:.0}", sheet.width, sheet.height)) role="img"
            font-family="sans-serif" font-size="15" fill="#263238" {
            title { "The vehicle from its right side" }
            @for body in &parameters.bodies {
                @let ([x, y], [width, height], is_frame) = body_outline(body);
                rect x=(px(x)) y=(px(y)) width=(px(width)) height=(px(height)) rx="6"
                    fill=(if is_frame { "#cfd8dc" } else { "#eceff1" }) stroke="#90a4ae" {}
                @if !is_frame {
                    text x=(px(x + 0.5 * width)) y=(px(y + 0.45 * height)) text-anchor="middle" { (body.name) }
                }
            }
            line x1=(px(MARGIN)) x2=(px(sheet.width - MARGIN)) y1=(px(sheet.y(0.0))) y2=(px(sheet.y(0.0)))
                stroke="#263238" stroke-width="3" {}
            @for (number, wheelset) in parameters.wheelsets.iter().enumerate() {
                @let (x, y) = (sheet.x(wheelset.x_m), sheet.y(wheelset.radius_m));
                circle cx=(px(x)) cy=(px(y)) r=(px(SCALE * wheelset.radius_m))
                    fill="#fff" stroke="#455a64" stroke-width="3" {}
                text x=(px(x)) y=(px(y + 5.0)) text-anchor="middle" font-weight="bold" { (number + 1) }
                text x=(px(x)) y=(px(sheet.y(-0.45))) text-anchor="middle" { (wheelset.name) }
            }
            @for element in parameters.dampers() {
                @let [at, _, height] = element.ends[1].at_m;
                @let is_vertical = matches!(
                    &element.law,
                    Law::Damper { direction: Direction::Vertical, .. }
                );
                @if is_vertical {
                    line x1=(px(sheet.x(at))) x2=(px(sheet.x(at))) y1=(px(sheet.y(height - 0.05)))
                        y2=(px(sheet.y(height + 0.55))) stroke="#1565c0" stroke-width="6" {}
                } @else {
                    circle cx=(px(sheet.x(at))) cy=(px(sheet.y(height + 0.25))) r="6" fill="#c62828" {}
                }
            }
            text x=(px(sheet.width - MARGIN)) y=(px(sheet.y(SKY_M - 0.32))) text-anchor="end" {
                "direction of travel →"
            }
            @if parameters.dampers().next().is_some() {
                text x=(px(MARGIN)) y=(px(sheet.y(-0.95))) {
                    "blue: vertical dampers; red: lateral and longitudinal dampers"
                }
            }
        }
    }
}

/// Formats a length to a tenth of a pixel.
fn px(value: f64) -> String {
    format!("{value:.1}")
}
