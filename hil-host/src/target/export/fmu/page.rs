//! The page of documentation within an FMU.

use maud::{DOCTYPE, html};

use super::Fmu;
use crate::target::export::Word;

impl<T: Word> Fmu<T> {
    /// `documentation/index.html`.
    pub(super) fn page(&self) -> String {
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                head { meta charset="utf-8"; title { (self.identifier) } }
                body {
                    h1 { (self.title()) }
                    p {
                        "Displacement in, force out; the force resists extension when it is positive. The same bits as "
                        code { "dashpot replay --scalar " (T::NAME) }
                        ", where the communication step is the internal step and no velocity is given."
                    }
                    p {
                        "A communication step of h from t ends at displacement_m + h velocity_m_per_s and goes there in a straight \
                         line from where the last one ended. Without velocity the force at t + h is thus that of the displacement at \
                         t: one communication step late. With it, it is that of t + h."
                    }
                    p {
                        "h is a multiple of " (self.step_s) " s, or the step is refused and nothing changes. A displacement that is not \
                         finite is held, one faster than the damper allows is limited: a warning once, and a bit of status. \
                         clearance_m may be changed between steps."
                    }
                    @if self.is_loaded {
                        p {
                            "The constants are images in the folder resources (dashpot export --lang bin), for this step and scalar; \
                             another image under the same name is another damper."
                        }
                    }
                }
            }
        };
        page.into_string()
    }
}
