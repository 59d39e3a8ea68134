// Journals that rest on contacts of which one carries a hundredth of what the others do: the pose bends by enough to let go of it, and without
// it the insert turns as far as its play lets it. Held against minima of the energy over all places of the bodies, found by another program with
// finite rotations (3e-7 N of some 30 N left).
#include <gtest/gtest.h>

#include "boresight/formulations/ideal_simulation.hpp"
#include "boresight/io/mechanism_file.hpp"
#include "boresight/ladder/ladder.hpp"
#include "boresight/multibody/multibody_start.hpp"

namespace boresight {
namespace rest_on_light_contacts_test {

constexpr const char* kGuideThenSleeve = R"toml(format = 1
name = "x"
gravity = ["5.488524119283 m/s^2", "6.244393032293 m/s^2", "-5.207663454017 m/s^2"]
[[body]]
name = "b0"
mass = "2.087882801527 kg"
center_of_mass = ["-0.1412845734916 m", "0.1147056409909 m", "0.1140714216078 m"]
inertia = ["0.01 kg m^2", "0.012 kg m^2", "0.015 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
[[body]]
name = "b1"
mass = "1.535666780583 kg"
center_of_mass = ["-0.05107860070926 m", "-0.2579103739348 m", "0.5032097788919 m"]
inertia = ["0.01 kg m^2", "0.012 kg m^2", "0.015 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
boresight = [0.1171634484277, -0.8274235311757, 0.549220380548]
[[joint]]
name = "J0"
type = "prismatic"
connects = ["ground", "b0"]
point = ["-0.09776867289175 m", "-0.02620759384887 m", "0.2495585987087 m"]
axis = [0.3726504516671, -0.9279671262593, -0.002941675435147]
driven = true
[[joint]]
name = "J1"
type = "prismatic"
connects = ["b0", "b1"]
point = ["-0.0407403090544 m", "-0.04271639814057 m", "0.4719442731638 m"]
axis = [-0.8988514116131, -0.001513622293973, -0.4382508970769]
driven = true
[initial]
journals = "rest"
[motion]
duration = "0.004 s"
[motion.drives]
J0 = "0"
J1 = "0"
[[clearance]]
joint = "J0"
journal = "b0"
width_gap = "9.873223999449e-05 m"
height_gap = "4.957806341219e-05 m"
width = "0.04906798607949 m"
height = "0.04787079163296 m"
length = "0.0388846292881 m"
guide = "rectangular"
width_direction = [0.4949136480717, 0.2014255797482, -0.8452740483272]
axes = "free"
[clearance.contact]
law = "lankarani-nikravesh"
restitution = 0.5
young = ["70 GPa", "70 GPa"]
poisson = [0.3, 0.3]
stiffness_scale = 1
[clearance.friction]
law = "none"
[[clearance]]
joint = "J1"
journal = "b0"
radial = "3.735840211376e-05 m"
journal_radius = "0.01284786431297 m"
sleeve_length = "0.04311891449275 m"
axes = "parallel"
[clearance.contact]
law = "lankarani-nikravesh"
restitution = 0.5
young = ["70 GPa", "70 GPa"]
poisson = [0.3, 0.3]
stiffness_scale = 1
[clearance.friction]
law = "none"
)toml";

constexpr const char* kGuideThenTiltingSleeve = R"toml(format = 1
name = "x"
gravity = ["-5.965128463782 m/s^2", "-7.59216459124 m/s^2", "-1.735620704561 m/s^2"]
[[body]]
name = "b0"
mass = "1.874496000259 kg"
center_of_mass = ["-0.2399811600385 m", "0.1743546216912 m", "-0.2916975985776 m"]
inertia = ["0.01 kg m^2", "0.012 kg m^2", "0.015 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
[[body]]
name = "b1"
mass = "1.390172786958 kg"
center_of_mass = ["-0.03381994529809 m", "-0.2740484191587 m", "-0.2089215864272 m"]
inertia = ["0.01 kg m^2", "0.012 kg m^2", "0.015 kg m^2", "0 kg m^2", "0 kg m^2", "0 kg m^2"]
boresight = [-0.4757059648384, -0.8369718376996, -0.2705216773475]
[[joint]]
name = "J0"
type = "prismatic"
connects = ["ground", "b0"]
point = ["-0.1204255403974 m", "0.03642748606185 m", "-0.2484518140563 m"]
axis = [0.4707144452982, 0.8203564303705, -0.3247202459615]
driven = true
[[joint]]
name = "J1"
type = "revolute"
connects = ["b0", "b1"]
point = ["-0.3488261008434 m", "0.3879123433182 m", "-0.2625556884564 m"]
axis = [-0.3044276216692, 0.6409652210455, -0.7046186263326]
driven = true
[initial]
journals = "rest"
[motion]
duration = "0.004 s"
[motion.drives]
J0 = "0"
J1 = "0"
[[clearance]]
joint = "J0"
journal = "b0"
width_gap = "9.866417954289e-05 m"
height_gap = "8.276878821381e-05 m"
width = "0.02946810469935 m"
height = "0.04116001113768 m"
length = "0.04495905365991 m"
guide = "rectangular"
width_direction = [0.01456882663396, -0.3752213176053, -0.9268207551113]
axes = "free"
[clearance.contact]
law = "lankarani-nikravesh"
restitution = 0.5
young = ["70 GPa", "70 GPa"]
poisson = [0.3, 0.3]
stiffness_scale = 1
[clearance.friction]
law = "none"
[[clearance]]
joint = "J1"
journal = "b0"
radial = "3.808786618905e-05 m"
axial = "5.01645096765e-05 m"
journal_radius = "0.01236395148939 m"
cap_radius = "0.022 m"
sleeve_length = "0.04346288392008 m"
axes = "free"
[clearance.contact]
law = "lankarani-nikravesh"
restitution = 0.5
young = ["70 GPa", "70 GPa"]
poisson = [0.3, 0.3]
stiffness_scale = 1
[clearance.friction]
law = "none"
)toml";

void expect_rest(const char* text, double boresight) {
  const auto mechanism = std::make_shared<const Mechanism>(read_mechanism_text(text, "chain.toml"));
  RunOptions options;
  options.sample_spacing = 0.0;
  options.model_look = ModelLook::none;
  // The drives stand still, and so does what rests.
  const RunResult result = make_rung("multibody", mechanism)->run(mechanism->parameters(), options);
  EXPECT_NEAR(result.index.boresight_error.max / boresight, 1.0, 1e-3);
  EXPECT_NEAR(result.index.boresight_error.rms / boresight, 1.0, 1e-3);
  const RestingBodies rest =
      resting_bodies(*mechanism, mechanism->parameters(), ideal_motion(*mechanism, mechanism->parameters()));
  EXPECT_EQ(rest.remark, "");
  EXPECT_EQ(rest.refusal, "");
}

TEST(RestOnLightContacts, OfASleeveBehindAGuideWhoseLoadActsJustBeyondItsEnd) {
  expect_rest(kGuideThenSleeve, 2.09041e-3);
}

TEST(RestOnLightContacts, OfASleeveThatTiltsBehindOne) { expect_rest(kGuideThenTiltingSleeve, 4.5926e-3); }

}  // namespace rest_on_light_contacts_test
}  // namespace boresight
