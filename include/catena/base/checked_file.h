#ifndef catena_base_checked_file_h
#define catena_base_checked_file_h

#include <string>
#include <vector>

namespace Catena
{
  /**
   * A file that tells whether it is as it was written. All integers are those
   * of a little-endian machine.
   *
   * | bytes | content                                                     |
   * |-------|-------------------------------------------------------------|
   * | 16    | "Catena state", filled up with zeros                        |
   * | 4     | version of the content                                      |
   * | 4     | CRC-32 of the content                                       |
   * | 8     | length of the content                                       |
   * | 4     | CRC-32 of the 32 bytes before                               |
   * | ...   | the content                                                 |
   */
  namespace CheckedFile
  {
    /**
     * Write a content in @p pieces as @p path, a WholeFile.
     *
     * @throws CheckpointError if it cannot be written; nothing is left of it
     */
    void
    write(const std::string              &path,
          const unsigned int              version,
          const std::vector<std::string> &pieces);

    /**
     * The content of @p path.
     *
     * @throws CheckpointError if there is no such file, if it is of another
     * version, or damaged in any way
     */
    std::string
    read(const std::string &path, const unsigned int version);
  } // namespace CheckedFile
} // namespace Catena

#endif
