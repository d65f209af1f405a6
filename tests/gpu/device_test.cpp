// The layer over OpenGL on a context without a window.
#include <QTest>
#include <numeric>

#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "tests/gpu/buffer_storage.h"
#include "tests/support/test_program.h"

namespace tidemark::test::device_test {

using namespace tidemark::gpu;

namespace {

std::shared_ptr<gpu::Device> make_device(gpu::GlVersion version = gpu::GlVersion::gl45) {
  auto device = gpu::Device::create_headless({version, true});
  if (!device) qFatal("%s", device.error().message.c_str());
  return *device;
}

}  // namespace

class DeviceTest : public QObject {
  Q_OBJECT

 private slots:
  void capabilities_are_known_and_printable() {
    const auto device = make_device();
    const gpu::Capabilities& capabilities = device->capabilities();
    QVERIFY(capabilities.at_least(4, 5));
    QVERIFY(!capabilities.renderer.empty());
    QVERIFY(capabilities.largest_texture >= 16384);
    QVERIFY(capabilities.largest_storage_buffer >= 1 << 27);
    for (const auto& [name, value] : capabilities.entries()) QVERIFY2(!value.empty(), name.c_str());
  }

  void an_older_context_can_be_had() {
    const auto device = make_device(gpu::GlVersion::gl33);
    QVERIFY(device->capabilities().at_least(3, 3));
    QVERIFY(device->make_current());
  }

  void two_contexts_take_turns() {
    const auto one = make_device();
    const auto other = make_device();
    QVERIFY(one->make_current());
    auto a = gpu::Buffer::create(*one, 4, "a");
    QVERIFY(other->make_current());
    auto b = gpu::Buffer::create(*other, 4, "b");
    QVERIFY(a && b);
    const std::int32_t value = 7;
    QVERIFY(one->make_current());
    a->upload_values<std::int32_t>(0, std::span(&value, 1));
    QCOMPARE(a->download_values<std::int32_t>(0, 1).front(), 7);
    QVERIFY(other->make_current());
    QCOMPARE(b->download_values<std::int32_t>(0, 1).front(), 0);
  }

  void buffers_and_textures_keep_what_they_are_given() {
    const auto device = make_device();
    std::vector<float> values(12 * 5);
    std::iota(values.begin(), values.end(), 1.0F);
    auto texture = gpu::Texture2D::create(*device, gpu::TexelFormat::r32f, 16, 8, "test");
    QVERIFY(texture);
    texture->upload({2, 1, 12, 5}, std::as_bytes(std::span(values)));
    auto larger = gpu::Texture2D::create(*device, gpu::TexelFormat::r32f, 32, 32, "larger");
    auto source = gpu::Framebuffer::create(*device, {&*texture}, "copy");
    QVERIFY(larger && source);
    source->copy_to({2, 1, 12, 5}, *larger, 20, 27);
    std::vector<float> read(values.size());
    QVERIFY(larger->download({20, 27, 12, 5}, std::as_writable_bytes(std::span(read))));
    QCOMPARE(read, values);
    QCOMPARE(device->severe_messages(), std::int64_t{0});
  }

  void readback_arrives_later() {
    const auto device = make_device();
    auto buffer = gpu::Buffer::create(*device, 64, "numbers");
    auto readback = gpu::Readback::create(*device, 16, "on its way");
    QVERIFY(buffer && readback);
    std::vector<std::int32_t> numbers(16);
    std::iota(numbers.begin(), numbers.end(), 0);
    buffer->upload_values<std::int32_t>(0, numbers);
    readback->start(*device, *buffer, 32);
    std::vector<std::int32_t> read(4);
    QVERIFY(readback->finish(std::as_writable_bytes(std::span(read))));
    QCOMPARE(read, (std::vector<std::int32_t>{8, 9, 10, 11}));
    QVERIFY(readback->ready());
  }

  // A driver moves what can be mapped to where atomic operations of shaders are lost.
  void a_buffer_cannot_be_mapped() {
    const auto device = make_device();
    const auto buffer = gpu::Buffer::create(*device, 64, "stays");
    QVERIFY(buffer);
    QVERIFY(cannot_be_mapped(*buffer));
  }

  void handles_are_counted_and_move() {
    const auto device = make_device();
    {
      auto first = gpu::Buffer::create(*device, 4, "first");
      QVERIFY(first);
      QCOMPARE(device->handles(), std::int64_t{1});
      gpu::Buffer second = std::move(*first);
      QCOMPARE(device->handles(), std::int64_t{1});
      second = gpu::Buffer();
      QCOMPARE(device->handles(), std::int64_t{0});
    }
    QCOMPARE(device->handles(), std::int64_t{0});
  }

  void a_shader_that_does_not_compile_says_where() {
    const auto device = make_device();
    const auto program = gpu::Program::compute(*device, "solver/compute/update.comp", {});
    QVERIFY(!program);
    QCOMPARE(program.error().kind, ErrorKind::internal);
    QVERIFY2(program.error().message.find(".glsl:") != std::string::npos, program.error().message.c_str());
  }

  void what_is_too_large_is_refused() {
    const auto device = make_device();
    const std::int64_t limit = device->capabilities().largest_texture;
    const auto texture = gpu::Texture2D::create(*device, gpu::TexelFormat::r32f, limit + 1, 4, "too wide");
    QVERIFY(!texture);
    QCOMPARE(texture.error().kind, ErrorKind::capability);
    const Index3 size(device->capabilities().largest_volume_texture + 1, 1, 1);
    QCOMPARE(gpu::Texture3D::create(*device, gpu::TexelFormat::r8, size, {}, "too long").error().kind,
             ErrorKind::capability);
  }

  void a_lost_context_stays_lost_and_nothing_is_deleted_in_it() {
    const auto device = make_device();
    {
      auto buffer = gpu::Buffer::create(*device, 4, "goes with its context");
      QVERIFY(buffer);
      device->lose_at_check(2);
      QVERIFY(device->check("the first"));
      const auto lost = device->check("the second");
      QVERIFY(!lost);
      QCOMPARE(lost.error().kind, ErrorKind::capability);
      QVERIFY(lost.error().message.find("the second") != std::string::npos);
      QVERIFY(device->lost());
      QVERIFY(!gpu::Buffer::create(*device, 4, "too late"));
    }
    QCOMPARE(device->handles(), std::int64_t{0});
  }
};

TIDEMARK_TEST(DeviceTest)

}  // namespace tidemark::test::device_test

#include "device_test.moc"
