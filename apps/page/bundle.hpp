// The browser side of the report, as bundled when building and embedded by bundle.S.
#pragma once

#include <string_view>

extern "C" {
extern const char boresight_report_script[];
extern const char boresight_report_script_end[];
extern const char boresight_report_style[];
extern const char boresight_report_style_end[];
}

namespace boresight::report {

inline std::string_view bundled_script() {
  return {boresight_report_script, static_cast<std::size_t>(boresight_report_script_end - boresight_report_script)};
}
inline std::string_view bundled_style() {
  return {boresight_report_style, static_cast<std::size_t>(boresight_report_style_end - boresight_report_style)};
}

}  // namespace boresight::report
