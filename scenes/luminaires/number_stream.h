#pragma once
#include <cmath>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/luminaires/luminaire_text.h"

namespace scenes {

struct PlacedNumber {
  double value = 0;  ///< NaN: it could not be read; checks are written so that NaN passes
  Token place;
};

/// Numbers one after the other, with faults for what is none of them and for their end.
class NumberStream {
 public:
  /// `text` and `faults` must outlive the stream.
  NumberStream(const LuminaireText& text, std::size_t first_line, LuminaireFaults& faults)
      : tokens_(text, first_line), faults_(&faults) {}

  /// The file ended too early; this was a fault.
  [[nodiscard]] bool ended() const { return ended_; }

  [[nodiscard]] const Token& last() const { return tokens_.last(); }

  void each(std::size_t count, std::string_view what,
            const std::function<void(std::size_t, const PlacedNumber&)>& use);
  /// Fewer than `count` if the file ended.
  [[nodiscard]] std::vector<PlacedNumber> take(std::size_t count, std::string_view what);
  /// A fault if anything is left.
  void expect_end();

  /// A number that was read, as a count; none after a fault.
  std::optional<std::size_t> count(const PlacedNumber& number, std::size_t least,
                                   std::string_view what);

 private:
  [[nodiscard]] PlacedNumber read(const Token& token);
  [[nodiscard]] std::string remedy() const;

  TokenStream tokens_;
  LuminaireFaults* faults_;
  bool ended_ = false;
};

}  // namespace scenes
