#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "drivers/plc/word_order.hpp"

namespace graspd {
namespace {

constexpr std::array<WordOrder, 4> orders{WordOrder::abcd, WordOrder::cdab, WordOrder::badc, WordOrder::dcba};

TEST(WordOrder, PutsBytesWhereItsNameSays) {
  std::array<std::uint16_t, 2> words{};
  put_uint32(words, 0xA1B2C3D4U, WordOrder::abcd);
  EXPECT_EQ(words, (std::array<std::uint16_t, 2>{0xA1B2, 0xC3D4}));
  put_uint32(words, 0xA1B2C3D4U, WordOrder::cdab);
  EXPECT_EQ(words, (std::array<std::uint16_t, 2>{0xC3D4, 0xA1B2}));
  put_uint32(words, 0xA1B2C3D4U, WordOrder::badc);
  EXPECT_EQ(words, (std::array<std::uint16_t, 2>{0xB2A1, 0xD4C3}));
  put_uint32(words, 0xA1B2C3D4U, WordOrder::dcba);
  EXPECT_EQ(words, (std::array<std::uint16_t, 2>{0xD4C3, 0xB2A1}));
}

TEST(WordOrder, WritesFloatsAsIeee754) {
  std::array<std::uint16_t, 2> words{};
  put_float(words, 123.456F, WordOrder::abcd);
  EXPECT_EQ(words, (std::array<std::uint16_t, 2>{0x42F6, 0xE979}));
}

TEST(WordOrder, ReadsBackWhatItWrote) {
  for (const WordOrder order : orders) {
    std::array<std::uint16_t, 2> words{};
    for (const std::int32_t value :
         {0, 1, -1, 123456, std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()}) {
      put_int32(words, value, order);
      EXPECT_EQ(get_int32(words, order), value);
    }
    for (const float value : {0.0F, -0.001F, 123.456F, 1e20F}) {
      put_float(words, value, order);
      EXPECT_EQ(get_float(words, order), value);
    }
  }
}

TEST(WordOrder, KnowsItsNames) {
  for (const WordOrder order : orders) {
    WordOrder parsed = WordOrder::abcd;
    EXPECT_TRUE(parse_word_order(word_order_name(order), parsed));
    EXPECT_EQ(parsed, order);
  }
  WordOrder parsed = WordOrder::badc;
  EXPECT_FALSE(parse_word_order("big", parsed));
  EXPECT_EQ(parsed, WordOrder::badc);
}

}  // namespace
}  // namespace graspd
