// SPDX-License-Identifier: BSD-3-Clause
#include "network_arguments.hpp"

#include "choices.hpp"
#include "number_lists.hpp"
#include "option_flags.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string_view>

namespace hypermap::app {
namespace {

/// The enumerator of a name that one_of gave.
template <class Enum>
Enum enumerator(std::span<const std::string_view> names, const std::string& name) {
  return static_cast<Enum>(std::ranges::find(names, name) - names.begin());
}

CLI::Validator three_numbers() {
  const auto check = [](const std::string& text) -> std::string {
    const auto numbers = parse_numbers(text, 3, 3, "");
    return numbers ? "" : numbers.error().what;
  };
  return {check, "A,B,C"};
}

Result<std::array<double, 3>> channels_of(const std::string& text, const char* flag) {
  HYPERMAP_ASSIGN_OR_RETURN(const auto numbers, parse_numbers(text, 3, 3, flag));
  return std::array<double, 3>{numbers[0], numbers[1], numbers[2]};
}

}  // namespace

void NetworkArguments::add_to(CLI::App& command, CLI::Option& model) {
  const OptionTable& table = option_table(OnnxDetectorOptions{});
  command.add_option("--network-form", form, "what the outputs of --model mean (docs/CLI.md)")
      ->transform(one_of(kNetworkFormNames))
      ->capture_default_str()
      ->needs(&model);
  command
      .add_option("--network-side",
                  side_px,
                  "side of the square that images are fitted into; 0: the network's own, else 416")
      ->check(value_of_field(table, "input_side_px"))
      ->capture_default_str()
      ->needs(&model);
  command.add_option("--network-fit", fit, "how an image lies in the square; auto: by the form")
      ->transform(one_of(kImageFitNames))
      ->capture_default_str()
      ->needs(&model);
  command.add_option("--network-channels", channels, "order of the channels; auto: by the form")
      ->transform(one_of(kChannelOrderNames))
      ->capture_default_str()
      ->needs(&model);
  auto* divisor = command
                      .add_option("--network-stddev",
                                  stddev,
                                  "what the channels, of 0 .. 255, are divided by (without: by the "
                                  "form)")
                      ->check(three_numbers())
                      ->needs(&model);
  command.add_option("--network-mean", mean, "what is taken off the channels before (without: 0)")
      ->check(three_numbers())
      ->needs(divisor);
}

Result<OnnxDetectorOptions> NetworkArguments::applied_to(OnnxDetectorOptions options) const {
  options.network_form = enumerator<NetworkForm>(kNetworkFormNames, form);
  options.image_fit = enumerator<ImageFit>(kImageFitNames, fit);
  options.channel_order = enumerator<ChannelOrder>(kChannelOrderNames, channels);
  options.input_side_px = side_px;
  if (stddev) {
    HYPERMAP_ASSIGN_OR_RETURN(options.channel_stddev, channels_of(*stddev, "--network-stddev"));
  }
  if (mean) {
    HYPERMAP_ASSIGN_OR_RETURN(options.channel_mean, channels_of(*mean, "--network-mean"));
  }
  return options;
}

}  // namespace hypermap::app
