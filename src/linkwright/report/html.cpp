#include "linkwright/report/html.h"

#include <algorithm>
#include <string_view>

#include "linkwright/report/markup.h"
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
  out += "<title>" + escape(input.title) + "</title>\n<style>\n";
  out += report_css();
  out += viewer_css();
  out += "</style>\n</head>\n<body>\n";
  out += "<main id=\"static\" class=\"page\">\n" + static_page(input) + "</main>\n";
  if (!script.empty()) {
    out +=
        "<main id=\"app\" class=\"page\" hidden></main>\n<script type=\"application/json\" "
        "id=\"result-data\">";
    out += script_safe(input.result_json.empty() ? std::string("null") : input.result_json);
    out += "</script>\n<script type=\"application/json\" id=\"view-data\">";
    out += script_safe(study::to_json(view_data(input)));
    out += "</script>\n<script>\n";
    const auto& scenes = input.result.scenes;
    if (std::any_of(scenes.begin(), scenes.end(), [](const study::Scene& s) { return s.spatial(); })) {
      out += space_js();
      out += "</script>\n<script>\n";
    }
    out += script;
    out += "</script>\n";
  }
  out += "</body>\n</html>\n";
  return out;
}

}  // namespace linkwright::report
