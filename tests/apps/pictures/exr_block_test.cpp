#include "apps/pictures/exr_block.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace apps {
namespace {

// Samples of a channel lie on lines whose number its sampling divides, and a block may begin on
// any.
TEST(ExrBlock, HoldsTheSamplesOfLinesWhereverTheyBegin) {
  for (int sampling = 1; sampling <= 5; ++sampling) {
    Imf::ChannelList channels;
    channels.insert("C", Imf::Channel(Imf::FLOAT, 1, sampling));
    for (int lines = 1; lines <= 20; ++lines) {
      int most = 0;
      for (int first = 0; first < sampling; ++first) {
        most = std::max(most, (first + lines - 1) / sampling - first / sampling + 1);
      }
      EXPECT_EQ(ExrBlock::bytes(channels, 1, lines), 4 * most) << sampling << ", " << lines;
    }
  }
}

}  // namespace
}  // namespace apps
