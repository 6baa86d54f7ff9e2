// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/run_request.h"

#include <fmt/core.h>

#include <algorithm>
#include <tuple>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"
#include "linkwright/study/study.h"

namespace linkwright::serve {
namespace {

constexpr std::size_t max_files = 64;
constexpr std::size_t longest_name = 255, longest_tab = 64, longest_number = 16;

/// A name that stays in the folder it is put into.
bool is_plain_name(std::string_view name) {
  return !name.empty() && name.size() <= longest_name && name != "." && name != ".." &&
         std::none_of(name.begin(), name.end(), [](char c) { return c == '/' || c == '\\' || c == '\0'; });
}

bool read_files(const Value& files, RunRequest& request, std::string& problem) {
  if (!files.is_object() || files.as_object().size() > max_files) {
    problem = fmt::format("files: must be a table of at most {} texts", max_files);
    return false;
  }
  for (const auto& [name, text, position] : files.as_object()) {
    if (!is_plain_name(name) || !text.is_string()) {
      problem = "files: must be texts by names without a folder";
      return false;
    }
    request.files[name] = text.as_string();
  }
  return true;
}

}  // namespace

std::string_view tab_of(std::string_view run) {
  const std::size_t dot = run.find('.');
  if (dot > longest_tab || run.size() - dot > longest_number) return {};
  const std::string_view tab = run.substr(0, dot), number = run.substr(dot + 1);
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  const bool good = !number.empty() && std::all_of(number.begin(), number.end(), is_digit) &&
                    std::all_of(tab.begin(), tab.end(), [&](char c) { return is_digit(c) || is_letter(c); });
  return good ? tab : std::string_view();
}

std::optional<RunRequest> read_run_request(std::string_view body, std::string& problem) {
  Diagnostics diagnostics;
  const Value document = study::read_text(body, study::Syntax::json, "request", diagnostics);
  if (has_errors(diagnostics)) {
    problem = to_string(diagnostics.front());
    return std::nullopt;
  }
  RunRequest request;
  for (const auto& [name, member, required] : {std::tuple{"run", &RunRequest::run, true},
                                               {"text", &RunRequest::text, true},
                                               {"edits", &RunRequest::edits, false}}) {
    const Value* value = document.find(name);
    if (value ? !value->is_string() : required) {
      problem = fmt::format("{}: must be a text", name);
      return std::nullopt;
    }
    if (value) request.*member = value->as_string();
  }
  if (tab_of(request.run).empty()) {
    problem = "run: must be TAB.NUMBER, with at most 64 letters and digits for the tab";
    return std::nullopt;
  }
  if (const Value* seconds = document.find("seconds")) {
    if (!seconds->is_number() || !(seconds->as_number() >= 0)) {
      problem = "seconds: must be a number, 0 or more";
      return std::nullopt;
    }
    request.seconds = seconds->as_number();
  }
  if (const Value* files = document.find("files"); files && !read_files(*files, request, problem))
    return std::nullopt;
  return request;
}

}  // namespace linkwright::serve
