// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// Decodes a log that holds every message of ours with the classes of our jar, as lcm-spy does, and
// encodes it again. Arguments: the log, then the types that must be in it.
import java.io.ByteArrayOutputStream;
import java.io.DataOutputStream;
import java.util.Arrays;
import java.util.HashMap;
import java.util.HashSet;
import java.util.Map;
import java.util.Set;
import lcm.lcm.LCMDataInputStream;
import lcm.lcm.LCMEncodable;
import lcm.logging.Log;

public final class TypesTest {
  public static void main(String[] arguments) throws Exception {
    Map<Long, Class<?>> classes = new HashMap<>();
    Set<String> missing = new HashSet<>();
    for (String type : Arrays.asList(arguments).subList(1, arguments.length)) {
      Class<?> found = Class.forName("lio." + type);
      classes.put(found.getField("LCM_FINGERPRINT").getLong(null), found);
      missing.add(type);
    }
    Log log = new Log(arguments[0], "r");
    try {
      while (true) {
        Log.Event event = log.readNext();
        Class<?> found = classes.get(new LCMDataInputStream(event.data).readLong());
        if (found == null) {
          throw new AssertionError("no type of ours on " + event.channel);
        }
        Object message =
            found
                .getConstructor(java.io.DataInput.class)
                .newInstance(new LCMDataInputStream(event.data));
        ByteArrayOutputStream again = new ByteArrayOutputStream();
        ((LCMEncodable) message).encode(new DataOutputStream(again));
        if (!Arrays.equals(again.toByteArray(), event.data)) {
          throw new AssertionError(found + " does not encode as it came on " + event.channel);
        }
        missing.remove(found.getSimpleName());
      }
    } catch (java.io.EOFException end) {
      if (!missing.isEmpty()) {
        throw new AssertionError("not in the log: " + missing);
      }
    }
  }
}
