// Fields that are written page by page come back piece by piece, and share what they have in common.
#include "document/field_bytes.h"

#include <algorithm>
#include <cmath>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::field_bytes_test {

class FieldBytesTest : public QObject {
  Q_OBJECT

  static constexpr double kBand = 3.0;
  const Geometry grid_{{21, 18, 27}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {}};

  // A ball of so many voxels around (8, 8, 8), which lies in some of the pages.
  [[nodiscard]] solver::Field ball(double radius) const {
    std::vector<float> values;
    for (std::int64_t offset = 0; offset < grid_.voxel_count(); ++offset) {
      const double away = glm::distance(glm::dvec3(grid_.voxel_at(offset)), glm::dvec3(8.0));
      values.push_back(static_cast<float>(std::clamp(radius - away, -kBand, kBand)));
    }
    return solver::Field::from_dense(grid_, values, kBand);
  }
  static std::vector<std::byte> pages_of(const document::FieldBytes& bytes) {
    std::vector<std::byte> all;
    for (std::size_t n = 0; n < bytes.pages(); ++n) {
      const auto page = std::as_bytes(bytes.page(n));
      all.insert(all.end(), page.begin(), page.end());
    }
    return all;
  }
  [[nodiscard]] Result<document::FieldsReader> open(std::vector<std::int32_t> tables,
                                                    std::size_t pages) const {
    return document::FieldsReader::open(solver::Field::empty(grid_, kBand), std::move(tables), pages, "phi");
  }
  static void take(document::FieldsReader& reader, std::span<const std::byte> bytes, std::size_t piece) {
    for (; !bytes.empty(); bytes = bytes.subspan(std::min(piece, bytes.size())))
      reader.take(bytes.first(std::min(piece, bytes.size())));
  }

 private slots:
  void pieces_of_any_length_make_the_fields_data() {
    QTest::addColumn<int>("piece");
    for (const int piece : {1, 1000, 2048, 5000, 1 << 20}) QTest::addRow("%d bytes", piece) << piece;
  }

  void pieces_of_any_length_make_the_fields() {
    QFETCH(int, piece);
    const solver::Field small = ball(4.0);
    solver::Field changed = small;
    const std::vector<std::int64_t> stored = changed.pages.stored_pages();
    QVERIFY(stored.size() > 2);
    changed.pages.change(stored[1])[5] = 1.25F;
    document::FieldBytes bytes(small);
    bytes.add(changed);
    QCOMPARE(bytes.pages(), stored.size() + 1);
    auto reader = open(bytes.tables(), bytes.pages());
    QCOMPARE(failure(reader), QString());
    take(*reader, pages_of(bytes), static_cast<std::size_t>(piece));
    const auto fields = reader->fields();
    QCOMPARE(failure(fields), QString());
    QCOMPARE(fields->size(), std::size_t{2});
    QVERIFY((*fields)[0]->dense() == small.dense());
    QVERIFY((*fields)[1]->dense() == changed.dense());
    for (const std::int64_t page : stored) {
      const bool shared = (*fields)[0]->pages.values(page) == (*fields)[1]->pages.values(page);
      QCOMPARE(shared, page != stored[1]);
    }
  }

  void what_the_present_field_has_as_well_takes_no_memory() {
    const solver::Field present = ball(4.0);
    solver::Field other = present;
    const std::vector<std::int64_t> stored = other.pages.stored_pages();
    // Of a page that lies within the grid: padding is written as -band.
    const auto within = std::find_if(stored.begin(), stored.end(), [&](std::int64_t page) {
      return other.layout.valid_shape(page) == other.layout.page_shape();
    });
    QVERIFY(within != stored.end());
    other.pages.change(*within)[5] = 1.25F;
    const document::FieldBytes bytes(other);
    auto reader = document::FieldsReader::open(present, bytes.tables(), bytes.pages(), "phi");
    QCOMPARE(failure(reader), QString());
    reader->take(pages_of(bytes));
    const auto fields = reader->fields();
    QCOMPARE(failure(fields), QString());
    QVERIFY(fields->front()->dense() == other.dense());
    for (const std::int64_t page : stored) {
      if (other.layout.valid_shape(page) != other.layout.page_shape()) continue;
      const bool shared = fields->front()->pages.values(page) == present.pages.values(page);
      QCOMPARE(shared, page != *within);
    }
  }

  void what_does_not_fit_is_refused() {
    const document::FieldBytes bytes(ball(4.0));
    const std::vector<std::byte> pages = pages_of(bytes);
    auto cut = open(bytes.tables(), bytes.pages());
    cut->take(std::span(pages).first(pages.size() - 4));
    QCOMPARE(failure(cut->fields()), QString("phi: the page table or the pages have the wrong size"));
    auto longer = open(bytes.tables(), bytes.pages());
    longer->take(pages);
    longer->take(std::span(pages).first(2048));
    QCOMPARE(failure(longer->fields()), QString("phi: the page table or the pages have the wrong size"));
    auto unnamed = open(bytes.tables(), bytes.pages() + 1);
    QCOMPARE(failure(unnamed), QString("phi: the page table does not name all pages"));
    std::vector<std::int32_t> twice = bytes.tables();
    *std::find(twice.begin(), twice.end(), 1) = 0;
    QCOMPARE(failure(open(twice, bytes.pages())), QString("phi: the page table names page 0 twice"));
    std::vector<std::int32_t> short_table = bytes.tables();
    short_table.pop_back();
    QVERIFY(failure(open(short_table, bytes.pages())).contains("wrong size"));
  }
};

TIDEMARK_TEST(FieldBytesTest)

}  // namespace tidemark::test::field_bytes_test

#include "field_bytes_test.moc"
