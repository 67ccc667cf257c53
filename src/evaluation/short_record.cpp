#include "evaluation/short_record.hpp"

#include "errors/one_line.hpp"
#include "errors/short_number.hpp"
#include "numeric/words.hpp"
#include "prediction/prediction_fields.hpp"
#include "station/sweep_table.hpp"
#include "verdict/finding.hpp"
#include "verdict/regime_flags.hpp"

namespace mems_stiction {
namespace {

constexpr char kIndent[] = "  ";
constexpr char kBold[] = "1";
constexpr char kYellow[] = "33";

/// Text in a colour, or as it is.
class Paint {
 public:
  explicit Paint(bool has_colours) : has_colours_(has_colours) {}

  std::string operator()(const char* code, const std::string& text) const {
    return has_colours_ ? std::string("\033[") + code + "m" + text + "\033[0m" : text;
  }

 private:
  bool has_colours_;
};

const char* colourOf(Sticks sticks) {
  constexpr const char* kColours[] = {"1;32", "1;33", "1;31",
                                      "1;35"};  // green, yellow, red, violet
  return kColours[static_cast<int>(sticks)];
}

std::string lineOf(const std::string& label, const std::string& text) {
  return kIndent + label + ": " + text + "\n";
}

std::string statusText(const Prediction& prediction) {
  std::string text = lowered(replaced(word(prediction.status), "_", " "));
  if (prediction.is_bonded_by_load) text += " by the load";
  if (prediction.has_asperities) {
    text += ", " + countText(prediction.asperity_count, "contact");
  }
  return text;
}

std::string forceText(const Prediction& prediction, const RecordExtras& extras) {
  const ForceInterval interval = extras.pull_off_interval.value_or(ForceInterval());
  std::string text = withInterval(prediction.pull_off_force, interval.lower, interval.upper, "N");
  if (prediction.isLowerBound()) text += ", a lower bound";
  return text;
}

/// Whether the verdict gives this warning as its reason: people have read it then.
bool hasSaid(const std::optional<Verdict>& verdict, const std::string& warning) {
  return verdict && verdict->reason.find(warning) != std::string::npos;
}

/// The verdict's sentence, its word in colour.
std::string verdictLine(const std::optional<Verdict>& verdict, const Paint& paint) {
  if (!verdict) {
    return std::string(kIndent) +
           "Does it stick? That needs a device in --config: device/spring_stiffness, "
           "device/travel and device/contact_area; or a beam\n";
  }
  const std::string sentence = verdictSentence(*verdict);
  const std::size_t end = sentence.find(':');
  return kIndent + paint(colourOf(verdict->sticks), sentence.substr(0, end)) +
         sentence.substr(end) + "\n";
}

}  // namespace

std::string shortRecord(const std::string& file, const HeightMap& scan,
                        const Prediction& prediction, const RecordExtras& extras,
                        bool has_colours) {
  const Paint paint(has_colours);
  std::string text = paint(kBold, oneLine(file)) + "\n";
  text += lineOf("status", statusText(prediction));
  text += lineOf("pull-off force", forceText(prediction, extras));
  if (extras.half_space && extras.half_space->status == HalfSpaceStatus::kSolved) {
    text += lineOf("pull-off force of the half-space",
                   shortNumber(extras.half_space->pull_off_force) + " N");
  }
  text += verdictLine(extras.verdict, paint);
  const std::uint32_t flags = regimeFlags(prediction, scan.cellArea());
  for (const std::string& sentence : regimeFlagSentences(flags, modelDoubt(prediction)))
    text += lineOf(paint(kYellow, "outside the model's range"), sentence);
  for (const std::string& warning : extras.warnings) {
    if (!hasSaid(extras.verdict, warning))
      text += lineOf(paint(kYellow, "warning"), oneLine(warning));
  }
  if (!extras.convergence.empty()) text += convergenceTable(extras.convergence, kIndent);
  if (!extras.cleanings.empty()) text += cleaningTable(extras.cleanings, kIndent);
  if (extras.sweep) text += sweepTable(*extras.sweep, kIndent);
  return text;
}

}  // namespace mems_stiction
