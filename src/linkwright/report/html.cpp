// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/html.h"

#include <algorithm>
#include <string_view>

#include "linkwright/report/markup.h"
#include "linkwright/report/packed.h"
#include "linkwright/report/static_page.h"
#include "linkwright/report/view_data.h"
#include "linkwright/report/viewer.h"
#include "linkwright/study/write.h"

namespace linkwright::report {

std::string html(const ReportInput& input) {
  const std::string_view script = viewer_js();
  std::string out =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      // The file may load nothing, whatever its data say.
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src "
      "'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'\">\n";
  out += "<meta name=\"generator\" content=\"" + escape(input.tool) + "\">\n";
  // Title, answer and key figures are read at once, for they stay where they are; the rest is to be replaced
  // and not shown first.
  if (!script.empty())
    out +=
        "<style>.starting #static > :not(.verdict, .first) { display: none } "
        ".starting .first figure { visibility: hidden }</style>\n"
        "<script>document.documentElement.className = \"starting\"</script>\n";
  out += "<title>" + escape(input.title) + "</title>\n<style>\n";
  out += report_css();
  out += viewer_css();
  out += "</style>\n</head>\n<body>\n";
  out += "<main id=\"static\" class=\"page\">\n" + static_page(input) + "</main>\n";
  if (!script.empty()) {
    out += "<main id=\"app\" class=\"page\" hidden></main>\n";
    const auto carry = [&out](std::string_view id, std::string_view bytes) {
      out.append("<script type=\"text/plain\" id=\"").append(id).append("\">").append(packed(bytes));
      out += "</script>\n";
    };
    NumberPack numbers;
    carry("result-data", numbers.take(input.result_json.empty() ? "null" : input.result_json, ", "));
    carry("view-data", numbers.take(study::to_json(view_data(input)), ","));
    carry("numbers-index", numbers.index());
    carry("numbers", numbers.bytes());
    // Licences ask for their notices in every copy, so that these stay readable.
    std::string notices;
    const auto carry_script = [&](std::string_view id, std::string_view code) {
      if (const std::size_t from = code.find("/*!"); from != std::string_view::npos)
        notices.append(code.substr(from, code.find("*/", from) + 2 - from)).append("\n");
      carry(id, code);
    };
    const auto& scenes = input.result.scenes;
    if (std::any_of(scenes.begin(), scenes.end(), [](const study::Scene& s) { return s.spatial(); }))
      carry_script("space-script", space_js());
    carry_script("viewer-script", script);
    out.append("<script>\n").append(notices).append(boot_js()).append("</script>\n");
  }
  out += "</body>\n</html>\n";
  return out;
}

}  // namespace linkwright::report
