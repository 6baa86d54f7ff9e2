// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/math/formula.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"

namespace linkwright::math {
namespace {

// Whole exponents of metre, kilogram and second.
struct DimensionPowers {
  Dimension dimension;
  std::array<int, 3> of;
};
// The first of several dimensions with the same powers is the one that messages name.
constexpr DimensionPowers dimension_powers[] = {
    {Dimension::none, {0, 0, 0}},
    {Dimension::length, {1, 0, 0}},
    {Dimension::angle, {0, 0, 0}},
    {Dimension::time, {0, 0, 1}},
    {Dimension::frequency, {0, 0, -1}},
    {Dimension::speed_angular, {0, 0, -1}},
    {Dimension::acceleration, {1, 0, -2}},
    {Dimension::mass, {0, 1, 0}},
    {Dimension::inertia, {2, 1, 0}},
    {Dimension::area, {2, 0, 0}},
    {Dimension::speed, {1, 0, -1}},
    {Dimension::acceleration_angular, {0, 0, -2}},
    {Dimension::force, {1, 1, -2}},
    {Dimension::torque, {2, 1, -2}},
    {Dimension::jerk, {1, 0, -3}},
    {Dimension::jerk_angular, {0, 0, -3}},
    {Dimension::power, {2, 1, -3}},
    {Dimension::energy, {2, 1, -2}},
    {Dimension::stiffness, {0, 1, -2}},
    {Dimension::stiffness_angular, {2, 1, -2}},
    {Dimension::damping, {0, 1, -1}},
    {Dimension::damping_angular, {2, 1, -1}},
    {Dimension::angle_by_length, {-1, 0, 0}},
    {Dimension::density, {-3, 1, 0}},
    {Dimension::pressure, {-1, 1, -2}},
    {Dimension::second_moment_of_area, {4, 0, 0}},
};

Powers powers_of(Dimension dimension) {
  Powers out;
  for (const DimensionPowers& row : dimension_powers)
    if (row.dimension == dimension)
      for (std::size_t i = 0; i < 3; ++i) out.halves[i] = 2 * row.of[i];
  return out;
}

// "a length", "a number", "a quantity in kg m^2/s^3".
std::string in_words(const Powers& powers) {
  if (powers == Powers{}) return "a number";
  for (const DimensionPowers& row : dimension_powers)
    if (powers_of(row.dimension) == powers) return std::string(describe(row.dimension));
  std::string out;
  constexpr std::string_view units[] = {"m", "kg", "s"};
  for (std::size_t i = 0; i < 3; ++i) {
    const int halves = powers.halves[i];
    if (halves == 0) continue;
    out += fmt::format("{}{}", out.empty() ? "" : " ", units[i]);
    if (halves != 2) out += halves % 2 == 0 ? fmt::format("^{}", halves / 2) : fmt::format("^({}/2)", halves);
  }
  return "a quantity in " + out;
}

Powers times(const Powers& a, const Powers& b, int sign) {
  Powers out;
  for (std::size_t i = 0; i < 3; ++i) out.halves[i] = a.halves[i] + sign * b.halves[i];
  return out;
}

// A unit that a number may have, its factor to SI.
struct FormulaUnit {
  double factor = 1;
  Powers powers;
};

std::optional<FormulaUnit> unit_named(std::string_view name) {
  using enum Dimension;
  for (const Dimension dimension :
       {length, angle, time, mass, force, pressure, energy, power, frequency, speed_angular})
    if (const Unit* unit = find_unit(dimension, name); unit && name.find('_') == std::string_view::npos)
      return FormulaUnit{unit->to_si(1), powers_of(dimension)};
  return std::nullopt;
}

bool begins_name(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

// Reads by recursive descent; the steps are written in the order in which a stack takes them.
class FormulaReader {
 public:
  FormulaReader(std::string_view text, std::span<const FormulaName> names, const FormulaLookup& lookup,
                Formula& out, FormulaError& error)
      : text_(text), names_(names), lookup_(lookup), out_(out), error_(error) {}

  bool read(Dimension result) {
    if (text_.size() > Formula::max_length)
      return fail(1, fmt::format("has {} characters, {} are allowed", text_.size(), Formula::max_length));
    const auto found = either();
    if (!found) return false;
    skip();
    if (at_ < text_.size()) return fail(at_ + 1, fmt::format("'{}' is not expected here", shown(at_)));
    if (found->logical) return fail(1, "is a condition, and must be a value");
    if (!found->zero && found->powers != powers_of(result))
      return fail(1, fmt::format("is {}, and must be {}", in_words(found->powers), describe(result)));
    return true;
  }

 private:
  using Code = Formula::Code;
  struct Kind {
    Powers powers;
    bool logical = false;
    bool zero = false;  ///< the number 0, which is of any dimension
  };
  using Found = std::optional<Kind>;

  bool fail(std::size_t column, std::string message) {
    if (error_.message.empty()) error_ = {column, std::move(message)};
    return false;
  }
  std::nullopt_t none(std::size_t column, std::string message) {
    fail(column, std::move(message));
    return std::nullopt;
  }
  std::string shown(std::size_t at) const {
    if (at >= text_.size()) return "";
    if (!begins_name(text_[at])) {
      const auto c = static_cast<unsigned char>(text_[at]);
      return c < 0x20 || c > 0x7e ? fmt::format("\\x{:02x}", c) : std::string(1, text_[at]);
    }
    return std::string(name_at(at));
  }
  void skip() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t')) ++at_;
  }
  std::string_view name_at(std::size_t from) const {
    std::size_t end = from;
    while (end < text_.size() && (begins_name(text_[end]) || is_digit(text_[end]))) ++end;
    return text_.substr(from, end - from);
  }
  // Takes signs or a word that come next.
  bool take(std::string_view what) {
    skip();
    if (text_.substr(at_, what.size()) != what) return false;
    if (begins_name(what[0]) && name_at(at_) != what) return false;
    at_ += what.size();
    return true;
  }
  void step(Code code, double value = 0, std::size_t index = 0) {
    out_.steps_.push_back({code, value, index});
  }

  std::size_t next_column() {
    skip();
    return at_ + 1;
  }
  // The common dimension of two quantities; nothing, with an error at the second, if there is none.
  Found common(const Kind& a, const Kind& b, std::size_t column, std::string_view how) {
    if (a.logical || b.logical) return none(column, "a condition stands where a value is needed");
    if (a.zero) return Kind{b.powers, false, b.zero};
    if (b.zero || a.powers == b.powers) return Kind{a.powers};
    return none(column, fmt::format(fmt::runtime(how), in_words(b.powers), in_words(a.powers)));
  }
  bool need_value(const Kind& a, std::size_t column) {
    return !a.logical || fail(column, "a condition stands where a value is needed");
  }
  bool need_condition(const Kind& a, std::size_t column) {
    return a.logical || fail(column, "a value stands where a condition is needed");
  }

  Found either() {
    std::size_t column = next_column();
    Found a = both();
    while (a && take("or")) {
      if (!need_condition(*a, column)) return std::nullopt;
      column = next_column();
      const Found b = both();
      if (!b || !need_condition(*b, column)) return std::nullopt;
      step(Code::either);
    }
    return a;
  }
  Found both() {
    std::size_t column = next_column();
    Found a = opposite();
    while (a && take("and")) {
      if (!need_condition(*a, column)) return std::nullopt;
      column = next_column();
      const Found b = opposite();
      if (!b || !need_condition(*b, column)) return std::nullopt;
      step(Code::both);
    }
    return a;
  }
  Found opposite() {
    if (!take("not")) return comparison();
    const Depth deeper(*this);
    if (!deeper.allowed()) return std::nullopt;
    const std::size_t column = next_column();
    const Found a = opposite();
    if (!a || !need_condition(*a, column)) return std::nullopt;
    step(Code::opposite);
    return a;
  }
  Found comparison() {
    const Found a = sum();
    if (!a) return a;
    for (const auto& [sign, code] : {std::pair{"<=", Code::less_equal},
                                     {">=", Code::greater_equal},
                                     {"==", Code::equal},
                                     {"<", Code::less},
                                     {">", Code::greater}}) {
      if (!take(sign)) continue;
      const std::size_t column = next_column();
      const Found b = sum();
      if (!b || !common(*a, *b, column, "cannot compare {} with {}")) return std::nullopt;
      step(code);
      return Kind{{}, true};
    }
    return a;
  }
  Found sum() {
    Found a = product();
    while (a) {
      const bool more = take("+");
      if (!more && !take("-")) break;
      const std::size_t column = next_column();
      const Found b = product();
      if (!b) return b;
      a = common(*a, *b, column, more ? "cannot add {} to {}" : "cannot subtract {} from {}");
      step(more ? Code::plus : Code::minus);
    }
    return a;
  }
  Found product() {
    std::size_t column = next_column();
    Found a = negative();
    while (a) {
      const bool more = take("*");
      if (!more && !take("/")) break;
      if (!need_value(*a, column)) return std::nullopt;
      column = next_column();
      const Found b = negative();
      if (!b || !need_value(*b, column)) return std::nullopt;
      a = Kind{times(a->powers, b->powers, more ? 1 : -1)};
      step(more ? Code::times : Code::over);
    }
    return a;
  }
  Found negative() {
    const bool minus = take("-");
    if (!minus && !take("+")) return power();
    const Depth deeper(*this);
    if (!deeper.allowed()) return std::nullopt;
    const std::size_t column = next_column();
    const Found a = negative();
    if (!a || !need_value(*a, column)) return std::nullopt;
    if (minus) step(Code::negative);
    return a;
  }
  Found power() {
    const std::size_t column = next_column();
    const Found a = primary();
    if (!a || !take("^")) return a;
    if (!need_value(*a, column)) return std::nullopt;
    const std::size_t there = next_column();
    const bool minus = take("-");
    skip();
    double exponent = 0;
    if (!number(exponent)) return none(there, "an exponent is a number without unit");
    const std::size_t behind = at_;
    skip();
    if (at_ < text_.size() && begins_name(text_[at_]) && !is_word(name_at(at_)))
      return none(there, "an exponent is a number without unit");
    at_ = behind;
    if (minus) exponent = -exponent;
    Kind out;
    if (a->powers != Powers{}) {
      const double halves = 2 * exponent;
      if (halves != std::round(halves) || std::abs(halves) > 16)
        return none(there,
                    fmt::format("{} has exponents that are whole or half, up to 8", in_words(a->powers)));
      for (std::size_t i = 0; i < 3; ++i) {
        const int all = a->powers.halves[i] * static_cast<int>(halves);
        if (all % 2 != 0) return none(there, fmt::format("{} has no such power", in_words(a->powers)));
        out.powers.halves[i] = all / 2;
      }
    }
    step(Code::power, exponent);
    return out;
  }
  static bool is_word(std::string_view name) { return name == "and" || name == "or" || name == "not"; }

  // A number without sign.
  bool number(double& value) {
    const char *from = text_.data() + at_, *end = text_.data() + text_.size();
    if (at_ >= text_.size() || !(is_digit(*from) || *from == '.')) return false;
    const auto [behind, problem] = std::from_chars(from, end, value);
    if (problem != std::errc() || !std::isfinite(value)) return false;
    at_ += static_cast<std::size_t>(behind - from);
    return true;
  }

  // "mm", "mm2", "s^2" of a unit; nothing if no unit comes here.
  std::optional<FormulaUnit> one_unit() {
    if (at_ >= text_.size() || !begins_name(text_[at_])) return std::nullopt;
    std::string_view name = name_at(at_);
    int exponent = 1;
    auto unit = unit_named(name);
    std::size_t length = name.size();
    if (!unit && name.size() > 1 && name.back() >= '2' && name.back() <= '4') {
      unit = unit_named(name.substr(0, name.size() - 1));
      exponent = name.back() - '0';
    }
    if (!unit) return std::nullopt;
    at_ += length;
    if (exponent == 1 && at_ + 1 < text_.size() && text_[at_] == '^') {
      const bool minus = text_[at_ + 1] == '-';
      const std::size_t digit = at_ + (minus ? 2 : 1);
      if (digit < text_.size() && text_[digit] >= '1' && text_[digit] <= '4') {
        exponent = (minus ? -1 : 1) * (text_[digit] - '0');
        at_ = digit + 1;
      }
    }
    FormulaUnit out{std::pow(unit->factor, exponent), {}};
    for (std::size_t i = 0; i < 3; ++i) out.powers.halves[i] = exponent * unit->powers.halves[i];
    return out;
  }
  // The unit behind a number, of several that signs join without blanks.
  std::optional<FormulaUnit> unit() {
    auto out = one_unit();
    while (out && at_ < text_.size() && (text_[at_] == '*' || text_[at_] == '/')) {
      const std::size_t sign_at = at_;
      const int sign = text_[at_++] == '*' ? 1 : -1;
      const auto next = one_unit();
      if (!next) {
        at_ = sign_at;
        break;
      }
      out->factor *= sign > 0 ? next->factor : 1 / next->factor;
      out->powers = times(out->powers, next->powers, sign);
    }
    return out;
  }

  Found primary() {
    const Depth deeper(*this);
    if (!deeper.allowed()) return std::nullopt;
    const std::size_t column = next_column();
    if (take("(")) {
      const Found inner = either();
      if (!inner) return inner;
      if (!take(")")) return none(next_column(), "')' is missing");
      return inner;
    }
    if (double value = 0; number(value)) return with_unit(value);
    if (at_ >= text_.size()) return none(column, "a value is missing");
    if (!begins_name(text_[at_])) return none(column, fmt::format("'{}' is not expected here", shown(at_)));
    const std::string_view name = name_at(at_);
    at_ += name.size();
    skip();
    if (at_ < text_.size() && text_[at_] == '(') return call(name, column);
    if (name == "pi") {
      step(Code::number, pi);
      return Kind{};
    }
    for (std::size_t i = 0; i < names_.size(); ++i)
      if (names_[i].name == name) {
        step(Code::name, 0, i);
        return Kind{powers_of(names_[i].dimension)};
      }
    std::string all;
    for (const FormulaName& known : names_) all += fmt::format("{}, ", known.name);
    for (const std::string_view known : lookup_.functions) all += fmt::format("{}(\"...\"), ", known);
    if (all.size() > 2) all.resize(all.size() - 2);
    return none(column, fmt::format("nothing is called '{}' here; there are {} and pi", name, all));
  }
  Found with_unit(double value) {
    const std::size_t behind = at_;
    skip();
    if (const auto found = unit()) {
      step(Code::number, value * found->factor);
      return Kind{found->powers, false, false};
    }
    if (at_ < text_.size() && begins_name(text_[at_]) && !is_word(name_at(at_)))
      return none(at_ + 1, fmt::format("'{}' is not a unit; a product needs *", name_at(at_)));
    at_ = behind;
    step(Code::number, value);
    return Kind{{}, false, value == 0};
  }

  /// How a function treats its arguments.
  enum class Takes { number, same, root, ratio, sign };
  struct Function {
    std::string_view name;
    Code code;
    Takes takes;
    int arguments;  ///< -1: two or more
  };
  static std::span<const Function> functions() {
    static constexpr Function all[] = {
        {"sin", Code::sine, Takes::number, 1},          {"cos", Code::cosine, Takes::number, 1},
        {"tan", Code::tangent, Takes::number, 1},       {"asin", Code::arc_sine, Takes::number, 1},
        {"acos", Code::arc_cosine, Takes::number, 1},   {"atan", Code::arc_tangent, Takes::number, 1},
        {"atan2", Code::arc_tangent2, Takes::ratio, 2}, {"sqrt", Code::root, Takes::root, 1},
        {"abs", Code::magnitude, Takes::same, 1},       {"min", Code::least, Takes::same, -1},
        {"max", Code::greatest, Takes::same, -1},       {"exp", Code::exponential, Takes::number, 1},
        {"log", Code::logarithm, Takes::number, 1},     {"sign", Code::sign, Takes::sign, 1},
        {"floor", Code::whole, Takes::number, 1},       {"mod", Code::remainder, Takes::same, 2},
    };
    return all;
  }

  Found call(std::string_view name, std::size_t column) {
    ++at_;  // the bracket
    if (name == "if") return choice();
    if (name == "table") return table(column);
    if (std::find(lookup_.functions.begin(), lookup_.functions.end(), name) != lookup_.functions.end())
      return looked_up(name);
    const auto found = std::find_if(functions().begin(), functions().end(),
                                    [&](const Function& f) { return f.name == name; });
    if (found == functions().end()) {
      std::vector<std::string_view> known{"if", "table"};
      for (const Function& f : functions()) known.push_back(f.name);
      known.insert(known.end(), lookup_.functions.begin(), lookup_.functions.end());
      const std::string_view near = nearest_word(name, known);
      return none(column, fmt::format("there is no function '{}'{}", name,
                                      near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
    }
    Kind all;
    int count = 0;
    do {
      const std::size_t there = next_column();
      const Found argument = either();
      if (!argument || !need_value(*argument, there)) return std::nullopt;
      if (found->takes == Takes::number && !argument->zero && argument->powers != Powers{})
        return none(there, fmt::format("{} takes {}, found {}", name,
                                       found->code <= Code::tangent ? "an angle or a number" : "a number",
                                       in_words(argument->powers)));
      if (count == 0) {
        all = *argument;
      } else {
        const Found same = common(all, *argument, there, "{} does not go with {}");
        if (!same) return same;
        all = *same;
        if (found->arguments < 0) step(found->code);
      }
      ++count;
    } while (take(","));
    if (!take(")")) return none(next_column(), "')' is missing");
    if (found->arguments < 0 ? count < 2 : count != found->arguments)
      return none(column, fmt::format("{} takes {}, found {}", name,
                                      found->arguments < 0    ? "two values or more"
                                      : found->arguments == 1 ? "one value"
                                                              : "two values",
                                      count));
    if (found->arguments > 0) step(found->code);
    if (found->takes == Takes::root) {
      const Powers of = all.powers;
      for (int& halves : all.powers.halves) {
        if (halves % 2 != 0) return none(column, fmt::format("{} has no root", in_words(of)));
        halves /= 2;
      }
    }
    if (found->takes != Takes::same && found->takes != Takes::root) all.powers = {};
    return Kind{all.powers};
  }
  // A quantity by a name in quotes.
  Found looked_up(std::string_view function) {
    const std::size_t column = next_column();
    const char quote = at_ < text_.size() ? text_[at_] : ' ';
    if (quote != '"' && quote != '\'')
      return none(column, fmt::format("{} takes a name in quotes", function));
    const std::size_t end = text_.find(quote, at_ + 1);
    if (end == std::string_view::npos) return none(column, "the name has no closing quote");
    const std::string_view name = text_.substr(at_ + 1, end - at_ - 1);
    at_ = end + 1;
    std::string problem;
    const auto found = lookup_.find(function, name, problem);
    if (!found) return none(column, std::move(problem));
    if (!take(")")) return none(next_column(), "')' is missing");
    step(Code::name, 0, found->index);
    return Kind{powers_of(found->dimension)};
  }
  // A number of a table, with its sign and unit.
  Found constant(double& value) {
    const std::size_t column = next_column(), before = out_.steps_.size();
    const bool minus = take("-");
    skip();
    if (!number(value)) return none(column, "a table has numbers behind its argument");
    const Found kind = with_unit(value);
    if (!kind) return kind;
    value = (minus ? -1 : 1) * out_.steps_.back().value;
    out_.steps_.resize(before);
    return kind;
  }
  // table(argument, argument, value, argument, value, ...)
  Found table(std::size_t column) {
    const std::size_t there = next_column();
    const Found argument = either();
    if (!argument || !need_value(*argument, there)) return std::nullopt;
    Kind arguments = *argument;
    Found values;
    Formula::Rows rows;
    while (take(",")) {
      double number = 0;
      std::size_t place = next_column();
      const Found x = constant(number);
      if (!x) return x;
      const Found same = common(arguments, *x, place, "{} does not go with {}");
      if (!same) return same;
      arguments = *same;
      if (!rows.argument.empty() && !(number > rows.argument.back()))
        return none(place, "the arguments of a table rise");
      rows.argument.push_back(number);
      if (!take(",")) return none(next_column(), "a row of a table has an argument and a value");
      place = next_column();
      const Found y = constant(number);
      if (!y) return y;
      values = values ? common(*values, *y, place, "{} does not go with {}") : y;
      if (!values) return values;
      rows.value.push_back(number);
    }
    if (!take(")")) return none(next_column(), "')' is missing");
    if (rows.value.size() < 2)
      return none(column, "a table has two rows at least: table(argument, 0 mm, 10 N, 20 mm, 30 N)");
    step(Code::table, 0, out_.tables_.size());
    out_.tables_.push_back(std::move(rows));
    return values;
  }
  // Both values are computed; the condition takes one of them.
  Found choice() {
    std::size_t column = next_column();
    const Found condition = either();
    if (!condition || !need_condition(*condition, column)) return std::nullopt;
    if (!take(",")) return none(next_column(), "',' is missing: if(condition, value, other value)");
    const Found first = either();
    if (!first) return first;
    if (!take(",")) return none(next_column(), "',' is missing: if(condition, value, other value)");
    column = next_column();
    const Found second = either();
    if (!second) return second;
    if (!take(")")) return none(next_column(), "')' is missing");
    step(Code::choose);
    return common(*first, *second, column, "{} does not go with {}");
  }

  struct Depth {
    FormulaReader& of;
    explicit Depth(FormulaReader& reader) : of(reader) { ++of.depth_; }
    ~Depth() { --of.depth_; }
    Depth(const Depth&) = delete;
    bool allowed() const {
      return of.depth_ <= Formula::max_depth ||
             of.fail(of.at_ + 1, fmt::format("is nested more than {} deep", Formula::max_depth));
    }
  };

  std::string_view text_;
  std::span<const FormulaName> names_;
  const FormulaLookup& lookup_;
  Formula& out_;
  FormulaError& error_;
  std::size_t at_ = 0;
  int depth_ = 0;
};

std::optional<Formula> Formula::read(std::string_view text, Dimension result,
                                     std::span<const FormulaName> names, FormulaError& error,
                                     const FormulaLookup& lookup) {
  Formula out;
  error = {};
  if (!FormulaReader(text, names, lookup, out, error).read(result)) return std::nullopt;
  out.text_ = text;
  return out;
}

}  // namespace linkwright::math
