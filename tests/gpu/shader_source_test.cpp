// Shaders are put together from files, and the compiler's messages name those files. Needs no OpenGL.
#include <QTemporaryDir>
#include <QTest>
#include <fstream>
#include <map>

#include "gpu/shader_source.h"
#include "tests/support/test_program.h"

namespace tidemark::test::shader_source_test {

using namespace tidemark::gpu;

namespace {

gpu::ShaderReader reader(std::map<std::string, std::string> files) {
  return [files = std::move(files)](std::string_view path) -> Result<std::string> {
    const auto found = files.find(std::string(path));
    if (found == files.end()) return fail(ErrorKind::internal, "{}: no such shader", path);
    return found->second;
  };
}

const std::map<std::string, std::string> kFiles = {
    {"main.comp", "#include \"a.glsl\"\n#include \"b.glsl\"\nvoid main() {}\n"},
    {"a.glsl", "int a;\n"},
    {"b.glsl", "#include \"a.glsl\"\nint b;\n"},
};

}  // namespace

class ShaderSourceTest : public QObject {
  Q_OBJECT

 private slots:
  void files_are_included_once_and_lines_are_marked() {
    const auto source =
        gpu::assemble_shader("main.comp", "450 core", {{"N", "8"}, {"FLAG", ""}}, reader(kFiles));
    QVERIFY(source);
    QCOMPARE(source->text,
             std::string("#version 450 core\n#define N 8\n#define FLAG \n"
                         "#line 1 0\n#line 1 1\nint a;\n#line 2 0\n#line 1 2\n#line 2 2\nint b;\n#line 3 0\n"
                         "void main() {}\n"));
    QCOMPARE(source->files, (std::vector<std::string>{"main.comp", "a.glsl", "b.glsl"}));
  }

  void a_missing_file_is_named_with_the_line_that_wants_it() {
    auto files = kFiles;
    files["b.glsl"] = "int b;\n#include \"c.glsl\"\n";
    const auto source = gpu::assemble_shader("main.comp", "330 core", {}, reader(files));
    QVERIFY(!source);
    QCOMPARE(source.error().message, std::string("main.comp:2: b.glsl:2: c.glsl: no such shader"));
  }

  void messages_of_all_drivers_name_file_and_line() {
    const gpu::ShaderSource source{"", {"main.comp", "a.glsl"}};
    QCOMPARE(gpu::name_files("1:12(3): error: `x' undeclared", source),
             std::string("a.glsl:12: error: `x' undeclared\n"));
    QCOMPARE(gpu::name_files("0(7) : error C1008: undefined variable", source),
             std::string("main.comp:7: error C1008: undefined variable\n"));
    QCOMPARE(gpu::name_files("ERROR: 1:4: 'y' : undeclared identifier\nWARNING: 0:2: z", source),
             std::string("a.glsl:4: 'y' : undeclared identifier\nmain.comp:2: z\n"));
    QCOMPARE(gpu::name_files("9:1(1): error: no such file\nplain words", source),
             std::string("9:1(1): error: no such file\nplain words\n"));
  }

  void shaders_are_embedded_and_can_be_read_from_disk() {
    const auto embedded = gpu::read_shader("solver/paging.glsl");
    QVERIFY(embedded && embedded->find("page_origin") != std::string::npos);
    QVERIFY(!gpu::read_shader("solver/none.glsl"));
    const QTemporaryDir folder;
    std::ofstream((folder.path() + "/own.glsl").toStdString()) << "int own;\n";
    qputenv("TIDEMARK_SHADERS", folder.path().toUtf8());
    const auto own = gpu::read_shader("own.glsl");
    const auto missing = gpu::read_shader("solver/paging.glsl");
    qunsetenv("TIDEMARK_SHADERS");
    QVERIFY(own);
    QCOMPARE(*own, std::string("int own;\n"));
    QVERIFY(!missing && missing.error().message.find("solver/paging.glsl") != std::string::npos);
  }
};

TIDEMARK_TEST(ShaderSourceTest)

}  // namespace tidemark::test::shader_source_test

#include "shader_source_test.moc"
