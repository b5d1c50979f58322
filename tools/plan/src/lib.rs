//! How little a scene needs: the error of pictures predicted from pilots, and the cheapest recipe that will do.
//!
//! The error of a picture is that of `pm-view`: the root of relMSE, the mean over pixels and channels of (b - a)^2 /
//! (a^2 + 0.01), where a is the picture without noise and without blur. Its square is a sum, and each part is measured for itself
//! on a few pixels, with two independent sets of rays and two independent sets of photons:
//!
//! * noise of rays, which falls with eye rays and gather rays: what differs between sets of rays with the same photons;
//! * noise of photons, which no number of rays takes away: what differs between sets of photons, for both sets of rays alike;
//! * bias, the blur of the search radius: what differs between k photons of n and fewer of more, for both sets of rays *and* of
//!   photons alike, so that noise cancels in the mean; extrapolated to radius zero by the law that the points show.
//!
//! The [`Model`] of these gives each recipe an error; [`choose`] takes the cheapest, and [`plan`] tries the chosen with fresh
//! random numbers, corrects the model by that, and chooses again.
//!
//! | modules | are about |
//! | --- | --- |
//! | `estimate`, `replicates` | means over pixels with their intervals; squares without the noise of what is squared |
//! | `lots` | noise of photons from many small maps, and how much it differs from map to map |
//! | `law` | bias as a power of the search area, extrapolated to none |
//! | `recipe`, `times`, `traffic` | what is chosen among, and what it costs |
//! | `preview`, `pixels`, `rays`, `traced`, `answers` | pilots: which pixels, rays through them, photons, radiance |
//! | `survey`, `trial` | all parts measured for many recipes; one recipe measured as a whole |
//! | `evidence` | what all trials together say |
//! | `task` | what is to be planned |
//! | `model`, `choice`, `planning` | the error of any recipe; the cheapest that will do; all of it together |

mod answers;
mod choice;
mod estimate;
mod evidence;
mod law;
mod lots;
mod model;
mod pixels;
mod planning;
mod preview;
mod rays;
mod recipe;
mod replicates;
mod survey;
mod task;
mod times;
mod traced;
mod traffic;
mod trial;

pub use choice::{Choice, Rival, choose, frontier, frontier_of_map, nearest_in};
pub use estimate::Estimate;
pub use law::{Law, Point};
pub use model::{Model, Parts};
pub use planning::{NoPlan, Plan, Tried, Untried, Wanted, plan};
pub use recipe::{CAUSTICS_K, MOST_SEEN, PAPERS_MAP, Recipe};
pub use survey::{Effort, Survey};
pub use task::{Caustics, PlanError, Task, is_large};
pub use times::Times;
pub use traffic::{SearchBytes, Traffic, Trouble};
