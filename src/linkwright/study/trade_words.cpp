// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/trade_words.h"

#include <fmt/core.h>

#include <array>

#include "linkwright/core/diagnostic.h"

namespace linkwright::study {
namespace {

struct Synonyms {
  std::string_view ours;
  std::string_view theirs;  ///< in small letters and digits only, separated by blanks
};

// A word of the trade may mean several of ours; the first that is allowed counts.
constexpr std::array synonyms{
    Synonyms{"four_bar",
             "4bar fourbarlinkage 4barlinkage crankrocker gelenkviereck viergelenk viergelenkgetriebe "
             "kurbelschwinge quatrebarres cuatrobarras"},
    Synonyms{"slider_crank",
             "crankslider schubkurbel schubkurbelgetriebe biellemanivelle bielamanivela manivelacorredera"},
    Synonyms{"five_bar", "5bar 5r"},
    Synonyms{"linkage", "sixbar 6bar eightbar 8bar koppelgetriebe"},
    Synonyms{"serial_arm", "robotarm manipulator roboterarm"},
    Synonyms{"corner",
             "doublewishbone macpherson mcpherson multilink suspension wheelsuspension quartercar "
             "doppelquerlenker mehrlenker radaufhängung radaufhaengung doubletriangulation"},

    Synonyms{"ground", "frame base gestell steg bâti bati bastidor"},
    Synonyms{"crank", "kurbel antriebskurbel manivelle manivela"},
    Synonyms{"coupler", "floatinglink connectingrod koppel bielle biela acoplador"},
    Synonyms{"rod", "connectingrod conrod coupler pleuel koppel bielle biela"},
    Synonyms{"rocker", "follower schwinge abtriebsschwinge balancier balancín balancin"},
    Synonyms{"speed", "velocity drehzahl vitesse velocidad"},
    Synonyms{"mass", "weight masse gewicht masa"},
    Synonyms{"length", "länge laenge longueur longitud"},

    Synonyms{"revolute",
             "hinge pin pinjoint pivot pivote rotary drehgelenk gelenk scharnier charnière bisagra"},
    Synonyms{"prismatic", "slider slide sliding translational schubgelenk glissière corredera"},
    Synonyms{"pin_in_slot", "slot pinslot kulisse coulisse ranura"},
    Synonyms{"fixed", "weld welded rigid fest encastrement"},
    Synonyms{"gear", "gears gearpair zahnrad zahnradpaar engrenage engranaje"},

    Synonyms{"2RS-US", "doublewishbone doppelquerlenker doubletriangulation"},
    Synonyms{"RS-SP-US", "macpherson mcpherson"},
    Synonyms{"5US", "multilink fivelink mehrlenker fünflenker fuenflenker"},
    Synonyms{"RS", "wishbone aarm controlarm querlenker dreiecklenker dreieckslenker triangle triángulo"},
    Synonyms{"US", "tierod trackrod toelink twopointlink lenker stablenker spurstange biellette tirante"},
    Synonyms{"SP", "strut macpherson mcpherson damper federbein jambedeforce"},
    Synonyms{"RR", "trapezoidalarm trapezlenker"},
    Synonyms{"R", "trailingarm semitrailingarm längslenker schräglenker brastiré"},
    Synonyms{"S", "balljoint kugelgelenk rotule rótula"},

    Synonyms{"crank_rotates_fully", "grashof fullrotation umlauffähig umlauffaehig"},
    Synonyms{"transmission_angle", "übertragungswinkel uebertragungswinkel angledetransmission"},
    Synonyms{"synthesis", "design optimise optimize optimisation optimization auslegung"},
    Synonyms{"simulation", "dynamics dynamik dynamique"},
    Synonyms{"enumeration", "typesynthesis numbersynthesis structuralsynthesis typsynthese strukturanalyse"},
    Synonyms{"chain", "kinematicchain getriebekette kette chaînecinématique cadenacinemática"},
    Synonyms{"freedoms", "dof mobility degreesoffreedom freiheitsgrad freiheitsgrade"},
    Synonyms{"balancing", "massenausgleich équilibrage"},
};

/// In small letters, without blanks and punctuation.
std::string letters(std::string_view word) {
  std::string out;
  for (const char c : word) {
    if (c >= 'A' && c <= 'Z')
      out += static_cast<char>(c - 'A' + 'a');
    else if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || static_cast<unsigned char>(c) >= 0x80)
      out += c;
  }
  return out;
}

/// "four_bar" of "planar.four_bar".
std::string_view last_part(std::string_view name) {
  const std::size_t dot = name.rfind('.');
  return dot == std::string_view::npos ? name : name.substr(dot + 1);
}

bool lists(std::string_view words, std::string_view word) {
  for (std::size_t from = 0; from < words.size();) {
    const std::size_t end = std::min(words.find(' ', from), words.size());
    if (words.substr(from, end - from) == word) return true;
    from = end + 1;
  }
  return false;
}

}  // namespace

std::string_view meant_word(std::string_view word, const std::vector<std::string_view>& allowed) {
  const std::string whole = letters(word), last = letters(last_part(word));
  if (last.empty()) return {};
  for (const std::string_view candidate : allowed)
    if (letters(candidate) == whole) return candidate;
  for (const std::string_view candidate : allowed)
    if (letters(last_part(candidate)) == last) return candidate;
  for (const Synonyms& row : synonyms)
    if (lists(row.theirs, last))
      for (const std::string_view candidate : allowed)
        if (last_part(candidate) == row.ours) return candidate;
  return nearest_word(word, allowed);
}

std::string suggestion(std::string_view word, const std::vector<std::string_view>& allowed,
                       std::string otherwise) {
  const std::string_view meant = meant_word(word, allowed);
  return meant.empty() ? otherwise : fmt::format("did you mean '{}'?", meant);
}

}  // namespace linkwright::study
