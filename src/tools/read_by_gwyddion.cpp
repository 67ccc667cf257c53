/// read_by_gwyddion SCAN TARGET: Gwyddion's libraries read an instrument maker's file; the result
/// is written as a .gwy container. channelsByGwyddion() starts this program for each file: a
/// damaged file that crashes a reader ends this process and nothing else. No display is needed.
/// The libraries are GPL-2.0-or-later, and so is this program where it is passed on compiled;
/// nothing else links them.
///
/// The last line that it prints is what went wrong. Exit status: 0; 1 not read; 127 Gwyddion's
/// readers are not installed (the loader's status, too, where its libraries are missing).

#include <app/gwyapp.h>
#include <libgwyddion/gwyddion.h>
#include <libgwydgets/gwydgetutils.h>
#include <libgwymodule/gwymodule.h>

#include <cstdio>
#include <cstring>

namespace {

/// Its libraries print warnings about themselves.
void drop(const gchar*, GLogLevelFlags, const gchar*, gpointer) {}

/// @return false if there are none
bool startReaders(int argc, char** argv) {
  g_log_set_default_handler(&drop, nullptr);
  gtk_init_check(&argc, &argv);  // false without a display, which nothing here needs
  gwy_widgets_type_init();
  gwy_undo_set_enabled(FALSE);
  gchar** folders = gwy_app_settings_get_module_dirs();
  gwy_module_register_modules(const_cast<const gchar**>(folders));
  g_strfreev(folders);
  return gwy_module_lookup("gwyfile") != nullptr;
}

/// @return false if it cannot be written
bool writeContainer(GwyContainer* data, const char* path) {
  GByteArray* bytes = gwy_serializable_serialize(G_OBJECT(data), nullptr);
  std::FILE* file = std::fopen(path, "wb");
  if (file == nullptr) return false;
  const bool is_written = std::fwrite("GWYP", 1, 4, file) == 4 &&
                          std::fwrite(bytes->data, 1, bytes->len, file) == bytes->len;
  g_byte_array_free(bytes, TRUE);
  return std::fclose(file) == 0 && is_written;
}

int fail(const char* message, int status = 1) {
  std::printf("%.*s\n", static_cast<int>(std::strcspn(message, "\n")), message);
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return fail("usage: read_by_gwyddion SCAN TARGET");
  if (!startReaders(argc, argv)) return fail("Gwyddion's readers of files are not installed", 127);
  GError* error = nullptr;
  GwyContainer* data = gwy_file_load(argv[1], GWY_RUN_NONINTERACTIVE, &error);
  if (data == nullptr) return fail(error == nullptr ? "no cause is stated" : error->message);
  return writeContainer(data, argv[2]) ? 0
                                       : fail("what was read cannot be written: is the disk full?");
}
