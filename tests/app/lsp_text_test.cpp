// Messages and positions of the language server, without a server.

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "app/lsp/framing.h"
#include "app/lsp/text_document.h"

namespace rung::lsp {
namespace {

using Messages = std::vector<MessageReader::Message>;

Messages read_in_pieces(const std::string& bytes, std::size_t size) {
  MessageReader reader;
  Messages all;
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    reader.feed(std::string_view(bytes).substr(at, size));
    while (auto message = reader.next()) all.push_back(*message);
  }
  return all;
}

std::vector<std::string> bodies(const Messages& messages) {
  std::vector<std::string> all;
  for (const auto& message : messages) {
    all.push_back(message.error.empty() ? message.body : "ERROR");
  }
  return all;
}

TEST(Framing, TakesMessagesApartWhereverTheyAreCut) {
  const std::string bytes =
      frame("{}") + "content-length:  3 \r\nContent-Type: x\r\n\r\nabc" +
      frame("") + frame("\r\n\r\n");
  const std::vector<std::string> wanted = {"{}", "abc", "", "\r\n\r\n"};
  for (std::size_t size = 1; size <= bytes.size(); ++size) {
    EXPECT_EQ(bodies(read_in_pieces(bytes, size)), wanted) << size;
  }
}

TEST(Framing, GoesOnBehindAHeaderThatIsNone) {
  const char* const kHeaders[] = {
      "\r\n\r\n",
      "Content-Length: x\r\n\r\n",
      "Content-Length: -1\r\n\r\n",
      "Content-Length: 99999999999999999999999\r\n\r\n",
      "Content-Length:\r\n\r\n",
      "Content-Length: 2 2\r\n\r\n",
      "Content-Typ: y\r\n\r\n",
  };
  for (const char* const header : kHeaders) {
    EXPECT_EQ(bodies(read_in_pieces(header + frame("ok"), 7)),
              (std::vector<std::string>{"ERROR", "ok"}))
        << header;
  }
}

TEST(Framing, GoesOnBehindAHeaderWithoutEnd) {
  const std::string bytes =
      std::string(3 * MessageReader::kMaxHeader + 5, 'x') + frame("ok");
  for (const std::size_t size : {1U, 100U, 8192U, 100000U}) {
    EXPECT_EQ(bodies(read_in_pieces(bytes, size)),
              (std::vector<std::string>{"ERROR", "ok"}))
        << size;
  }
}

TEST(Framing, KeepsNothingOfABodyThatIsTooLong) {
  MessageReader reader;
  const std::size_t length = MessageReader::kMaxBody + 10;
  reader.feed("Content-Length: " + std::to_string(length) + "\r\n\r\n12345");
  ASSERT_FALSE(reader.next()->error.empty());
  const std::string block(std::size_t{1} << 20, 'y');
  std::size_t left = length - 5;
  while (left > 0) {
    const std::size_t now = std::min(left, block.size());
    reader.feed(std::string_view(block).substr(0, now));
    EXPECT_FALSE(reader.next());
    left -= now;
  }
  reader.feed(frame("ok"));
  EXPECT_EQ(reader.next()->body, "ok");
}

TEST(Framing, AnyBytesEnd) {
  std::mt19937 random(1);
  const std::string kPieces[] = {"Content-Length: ", "3", "\r\n", "\r", "\n",
                                 "\r\n\r\n",         "{", "x",    "\0"};
  for (int run = 0; run < 500; ++run) {
    std::string bytes;
    for (int i = 0; i < 40; ++i) bytes += kPieces[random() % 9];
    read_in_pieces(bytes, 1 + random() % 9);
  }
}

// An umlaut: 2 bytes, 1 unit. A clef: 4 bytes, 2 units of UTF-16.
const std::string kText = "a\u00e4\U0001d11eb\r\ncd\re\n";

TEST(TextDocument, ColumnsCountWhatWasAgreed) {
  const TextDocument text(kText);
  const auto column = [&](std::uint32_t offset, Encoding encoding) {
    return text.position(offset, encoding).column;
  };
  EXPECT_EQ(column(7, Encoding::Utf8), 7U);
  EXPECT_EQ(column(7, Encoding::Utf16), 4U);
  EXPECT_EQ(column(7, Encoding::Utf32), 3U);
  EXPECT_EQ(text.offset({0, 4}, Encoding::Utf16), 7U);
  EXPECT_EQ(text.offset({0, 3}, Encoding::Utf16), 3U) << "half of the clef";
  EXPECT_EQ(text.offset({0, 5}, Encoding::Utf8), 3U) << "a part of it";
}

TEST(TextDocument, PositionsPastAnEndAreTheEnd) {
  const TextDocument text(kText);
  EXPECT_EQ(text.offset({0, 99}, Encoding::Utf16), 8U) << "before the CR LF";
  EXPECT_EQ(text.offset({1, 99}, Encoding::Utf16), 12U) << "before the CR";
  EXPECT_EQ(text.offset({3, 99}, Encoding::Utf16), 15U);
  EXPECT_EQ(text.offset({77, 0}, Encoding::Utf16), 15U);
  EXPECT_EQ(text.offset({UINT32_MAX, UINT32_MAX}, Encoding::Utf16), 15U);
  EXPECT_EQ(TextDocument("").offset({1, 1}, Encoding::Utf8), 0U);
}

TEST(TextDocument, PositionsOfCharactersAreTurnedBack) {
  const TextDocument text(kText);
  for (const Encoding encoding :
       {Encoding::Utf8, Encoding::Utf16, Encoding::Utf32}) {
    for (const std::uint32_t at : {0U, 1U, 3U, 7U, 8U, 10U, 12U, 13U, 15U}) {
      EXPECT_EQ(text.offset(text.position(at, encoding), encoding), at);
    }
  }
}

TEST(TextDocument, ChangesMoveTheLines) {
  TextDocument text("one\ntwo\n");
  text.replace(3, 4, "\n\n");
  EXPECT_EQ(text.text(), "one\n\ntwo\n");
  EXPECT_EQ(text.offset({2, 0}, Encoding::Utf16), 5U);
  text.replace(7, 3, "X");  // a range that is none: nothing is taken away
  EXPECT_EQ(text.text(), "one\n\ntwXo\n");
}

}  // namespace
}  // namespace rung::lsp
