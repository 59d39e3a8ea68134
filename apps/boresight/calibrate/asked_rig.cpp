#include "calibrate/asked_rig.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>
#include <utility>

#include "boresight/io/csv_fields.hpp"
#include "boresight/io/text_lines.hpp"
#include "boresight/keys/units.hpp"
#include "boresight/keys/value_fault.hpp"
#include "boresight/mechanism/error.hpp"
#include "command_line/command.hpp"
#include "command_line/option_range.hpp"
#include "results/output_directory.hpp"

namespace boresight::app {
namespace {

bool is_quantity(const std::string& text, const SiUnit& unit) {
  try {
    parse_quantity(text, unit);
    return true;
  } catch (const ValueFault&) {
    return false;
  }
}

std::vector<int> channels_called(const std::string& text) {
  std::vector<std::string> known;
  for (const ChannelName& c : channel_names()) known.emplace_back(c.name);
  std::vector<int> channels;
  for (const std::string& field : csv_fields(text)) {
    const auto found = std::find(known.begin(), known.end(), trimmed(field));
    if (found == known.end())
      throw InputError(kCommandLine, "--make-channels", in_quotes(trimmed(field)),
                       "channels of pointing data, such as \"bx,by,bz\"", nearest_name(trimmed(field), known));
    const int channel = static_cast<int>(found - known.begin());
    if (std::find(channels.begin(), channels.end(), channel) != channels.end())
      throw InputError(kCommandLine, "--make-channels", in_quotes(*found) + " twice", "each channel once");
    channels.push_back(channel);
  }
  return channels;
}

}  // namespace

SyntheticRig AskedRig::rig() const {
  SyntheticRig rig;
  if (!seed.empty()) rig.seed = whole_number("--make-seed", seed, 0, std::numeric_limits<std::uint64_t>::max());
  if (!samples.empty()) rig.samples = static_cast<int>(whole_number("--make-samples", samples, 1, 1'000'000));
  const auto unit_of_channel = [](int c) { return std::string(channel_names()[static_cast<std::size_t>(c)].si_unit); };
  const bool angle = is_quantity(noise, kAngle), length = is_quantity(noise, kLength);
  if (!channels.empty())
    rig.channels = channels_called(channels);
  else if (angle)
    rig.channels = {6, 7, 8};
  else if (length)
    rig.channels = {0, 1, 2};
  if (angle || length) {
    rig.deviation = positive_quantity("--make-data", noise, angle ? kAngle : kLength);
    for (const int c : rig.channels)
      if (unit_of_channel(c) != (angle ? "rad" : "m"))
        throw InputError(kCommandLine, "--make-data",
                         in_quotes(noise) + " of noise on " + channel_names()[static_cast<std::size_t>(c)].name,
                         "a share, such as \"1 %\", for channels of other units");
  } else {
    rig.noise = positive_quantity("--make-data", noise, kRatio);
  }
  rig.bias = VecX::Zero(static_cast<Eigen::Index>(rig.channels.size()));
  if (offset.empty()) return rig;
  const double displaced = positive_quantity("--make-offset", offset, kLength);
  for (std::size_t c = 0; c < rig.channels.size(); ++c)
    if (rig.channels[c] < 3) rig.bias[static_cast<Eigen::Index>(c)] = displaced;
  if (std::none_of(rig.channels.begin(), rig.channels.end(), [](int c) { return c < 3; }))
    throw InputError(kCommandLine, "--make-offset", in_quotes(offset),
                     "channels that measure displacements, by --make-channels");
  return rig;
}

void AskedRig::refuse_without_noise() const {
  if (!noise.empty()) return;
  for (const auto& [option, text] : {std::pair{"--make-offset", &offset},
                                     {"--make-seed", &seed},
                                     {"--make-channels", &channels},
                                     {"--make-samples", &samples}})
    if (!text->empty())
      throw InputError(kCommandLine, option, in_quotes(*text) + " without --make-data",
                       "--make-data NOISE too, which writes the data; a calibration reads them as they are");
}

void check_that_data_may_be_written(const std::filesystem::path& file) {
  std::error_code error;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, error))) return;
  constexpr std::uintmax_t kMostSynthetic = 256u << 20;  // bytes
  if (std::filesystem::is_regular_file(file, error) && std::filesystem::file_size(file, error) <= kMostSynthetic &&
      !error) {
    std::ifstream stream(file, std::ios::binary);
    if (stream && is_synthetic({std::istreambuf_iterator<char>(stream), {}})) return;
  }
  throw OutputDirectoryError(
      file.string() +
      ": is there already, and not as --make-data wrote it; name another file in the study, or remove it");
}

}  // namespace boresight::app
