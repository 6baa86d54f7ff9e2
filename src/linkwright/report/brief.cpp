#include "linkwright/report/brief.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace linkwright::report {
namespace {

constexpr std::array<std::string_view, 6> stops = {"; ", ": ", ", ", ". ", " (", " → "};
constexpr std::array<std::string_view, 6> joints = {" at ", " in ", " of ", " for ", " and ", " + "};

bool digit(char c) { return c >= '0' && c <= '9'; }

std::size_t letters(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xc0) != 0x80; }));
}

// Only the last of several numbers that share a unit shows it: "at 0, 322.5 mm", "at 56.3°, -34.4°".
bool between_numbers(std::string_view before, std::string_view after) {
  const bool ends = !before.empty() && (digit(before.back()) || before.ends_with("°"));
  for (const std::string_view minus : {"-", "−"})
    if (after.starts_with(minus)) after.remove_prefix(minus.size());
  return ends && !after.empty() && digit(after.front());
}

bool stands_alone(std::string_view text, std::size_t end, std::string_view mark) {
  const std::string_view head = text.substr(0, end);
  return letters(head) <= longest_head &&
         std::count(head.begin(), head.end(), '(') == std::count(head.begin(), head.end(), ')') &&
         !(mark == ", " && between_numbers(head, text.substr(end + mark.size())));
}

template <class Marks>
std::size_t last_of(std::string_view text, const Marks& marks) {
  std::size_t best = 0;
  for (const std::string_view mark : marks)
    for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at + 1))
      if (stands_alone(text, at, mark)) best = std::max(best, at);
  return best;
}

}  // namespace

Brief brief(std::string_view text) {
  if (letters(text) <= longest_head) return {text, {}};
  std::size_t end = last_of(text, stops);
  if (end == 0) end = last_of(text, joints);
  if (end == 0)
    for (std::size_t at = text.find(' ');
         at != std::string_view::npos && letters(text.substr(0, at)) <= longest_head;
         at = text.find(' ', at + 1))
      end = at;
  if (end == 0) return {text, {}};
  return {text.substr(0, end), text.substr(end)};
}

}  // namespace linkwright::report
