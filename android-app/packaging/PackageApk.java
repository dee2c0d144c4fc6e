import com.android.apksig.ApkSigner;
import com.android.apksig.ApkVerifier;
import com.android.tools.r8.CompilationMode;
import com.android.tools.r8.D8;
import com.android.tools.r8.D8Command;
import com.android.tools.r8.JdkClassFileProvider;
import com.android.tools.r8.OutputMode;
import java.io.ByteArrayInputStream;
import java.io.ByteArrayOutputStream;
import java.io.DataInputStream;
import java.io.File;
import java.io.IOException;
import java.io.InputStream;
import java.nio.file.Files;
import java.nio.file.Path;
import java.security.KeyStore;
import java.security.PrivateKey;
import java.security.cert.X509Certificate;
import java.util.ArrayList;
import java.util.Arrays;
import java.util.List;
import java.util.Map;
import java.util.TreeMap;
import java.util.regex.Matcher;
import java.util.regex.Pattern;
import java.util.stream.Stream;
import java.util.zip.CRC32;
import java.util.zip.ZipEntry;
import java.util.zip.ZipFile;
import java.util.zip.ZipOutputStream;

/**
 * Puts an APK together: the classes as dex, the resources of aapt2, and whatever else the jars hold for the run time
 * (META-INF/services and resources); aligned and signed with the schemes v2 and v3. The result is verified before it
 * gets its name, and the same input gives the same bytes with the same key. Of the class path only what the app's own
 * classes lead to gets in; what they lead to and is nowhere fails the build ({@link Reachable}).
 *
 * <p>Run from its source, `java -cp (D8 and apksig) PackageApk.java`, by android-app/pom.xml.
 *
 * <p>Arguments: resources.apk, APK to write, minimum API level, android.jar, key store (PKCS12; made when it is not
 * there), class path of the program.
 */
final class PackageApk {
    /** What every debug key store of Android has. */
    private static final String PASSWORD = "android";
    private static final String ALIAS = "androiddebugkey";

    /** In jars, for compilers, shrinkers and people; no program reads it at run time. */
    private static final Pattern NOT_FOR_RUN_TIME = Pattern.compile(
        "META-INF/(MANIFEST\\.MF|[^/]*\\.(SF|DSA|RSA|EC|kotlin_module|version)|(maven|proguard|com\\.android\\.tools|versions)/.*"
            + "|kotlin-project-structure-metadata\\.json|(LICENSE|NOTICE|DEPENDENCIES|AL2\\.0|LGPL2\\.1)[^/]*)"
            + "|.*\\.(class|kotlin_builtins|kotlin_metadata|knm)|[A-Za-z]+Main/default/.*"
            + "|(.*/)?module-info.*|.*/");

    static final String SERVICES = "META-INF/services/";

    public static void main(String[] arguments) throws Exception {
        Path resources = Path.of(arguments[0]);
        Path apk = Path.of(arguments[1]);
        int minimumApi = Integer.parseInt(arguments[2]);
        Path androidJar = Path.of(arguments[3]);
        Path keyStore = Path.of(arguments[4]);
        List<Path> program =
            Arrays.stream(arguments[5].split(File.pathSeparator)).map(Path::of).filter(Files::exists).toList();

        Path work = Files.createTempDirectory(apk.toAbsolutePath().getParent(), "apk");
        try {
            Map<String, byte[]> javaResources = javaResources(program);
            Path classes = work.resolve("classes");
            new Reachable(program, androidJar, javaResources).copyTo(classes);
            dex(classes, androidJar, minimumApi, work);
            Path unsigned = work.resolve("unsigned.apk");
            write(resources, work, javaResources, unsigned);
            Path signed = work.resolve("signed.apk");
            sign(unsigned, signed, minimumApi, keyStore);
            verify(signed, minimumApi);
            compare(signed, javaResources);
            Files.move(signed, apk, java.nio.file.StandardCopyOption.REPLACE_EXISTING);
        } finally {
            try (Stream<Path> left = Files.walk(work)) {
                left.sorted(java.util.Comparator.reverseOrder()).forEach(path -> path.toFile().delete());
            }
        }
        System.out.println(apk + ": " + Files.size(apk) + " bytes");
    }

    private static void dex(Path classFiles, Path androidJar, int minimumApi, Path output) throws Exception {
        List<Path> classes;
        try (Stream<Path> files = Files.walk(classFiles)) {
            classes = files.filter(Files::isRegularFile).sorted().toList();
        }
        D8.run(
            D8Command.builder()
                .addProgramFiles(classes)
                .addLibraryFiles(androidJar)
                // android-all leaves out the classes of Java itself.
                .addLibraryResourceProvider(JdkClassFileProvider.fromSystemJdk())
                .setMinApiLevel(minimumApi)
                .setMode(CompilationMode.DEBUG)
                .setOutput(output, OutputMode.DexIndexed)
                .build());
    }

    /** By name. Service lists of several jars are joined; any other name may have one content only. */
    private static Map<String, byte[]> javaResources(List<Path> program) throws IOException {
        Map<String, byte[]> found = new TreeMap<>();
        for (Path entry : program) {
            if (Files.isDirectory(entry)) {
                try (Stream<Path> files = Files.walk(entry)) {
                    for (Path file : files.filter(Files::isRegularFile).toList()) {
                        String name = entry.relativize(file).toString().replace(File.separatorChar, '/');
                        put(found, name, Files.readAllBytes(file));
                    }
                }
            } else {
                try (ZipFile jar = new ZipFile(entry.toFile())) {
                    for (ZipEntry file : (Iterable<ZipEntry>) jar.stream().map(ZipEntry.class::cast)::iterator) {
                        put(found, file.getName(), bytes(jar, file));
                    }
                }
            }
        }
        return found;
    }

    private static void put(Map<String, byte[]> found, String name, byte[] content) throws IOException {
        if (NOT_FOR_RUN_TIME.matcher(name).matches()) return;
        byte[] before = found.get(name);
        if (before == null) {
            found.put(name, content);
        } else if (name.startsWith(SERVICES)) {
            ByteArrayOutputStream both = new ByteArrayOutputStream();
            both.write(before);
            both.write('\n');
            both.write(content);
            found.put(name, both.toByteArray());
        } else if (!Arrays.equals(before, content)) {
            throw new IOException("two jars have different contents for " + name);
        }
    }

    private static void write(Path resources, Path dexes, Map<String, byte[]> javaResources, Path apk) throws IOException {
        try (ZipOutputStream zip = new ZipOutputStream(Files.newOutputStream(apk)); ZipFile linked = new ZipFile(resources.toFile())) {
            for (ZipEntry entry : (Iterable<ZipEntry>) linked.stream().map(ZipEntry.class::cast)::iterator) {
                // From Android 11 on the resource table must not be compressed.
                boolean stored = entry.getMethod() == ZipEntry.STORED || entry.getName().equals("resources.arsc");
                add(zip, entry.getName(), bytes(linked, entry), stored);
            }
            try (Stream<Path> files = Files.list(dexes)) {
                for (Path dex : files.filter(file -> file.toString().endsWith(".dex")).sorted().toList()) {
                    add(zip, dex.getFileName().toString(), Files.readAllBytes(dex), false);
                }
            }
            for (Map.Entry<String, byte[]> file : javaResources.entrySet()) add(zip, file.getKey(), file.getValue(), false);
        }
    }

    private static void add(ZipOutputStream zip, String name, byte[] content, boolean stored) throws IOException {
        ZipEntry entry = new ZipEntry(name);
        entry.setTime(0);
        if (stored) {
            CRC32 checksum = new CRC32();
            checksum.update(content);
            entry.setMethod(ZipEntry.STORED);
            entry.setSize(content.length);
            entry.setCrc(checksum.getValue());
        }
        zip.putNextEntry(entry);
        zip.write(content);
        zip.closeEntry();
    }

    static byte[] bytes(ZipFile zip, ZipEntry entry) throws IOException {
        try (InputStream content = zip.getInputStream(entry)) {
            return content.readAllBytes();
        }
    }

    private static void sign(Path unsigned, Path signed, int minimumApi, Path keyStore) throws Exception {
        if (Files.notExists(keyStore)) makeKey(keyStore);
        KeyStore store = KeyStore.getInstance("PKCS12");
        try (InputStream content = Files.newInputStream(keyStore)) {
            store.load(content, PASSWORD.toCharArray());
        }
        PrivateKey key = (PrivateKey) store.getKey(ALIAS, PASSWORD.toCharArray());
        X509Certificate certificate = (X509Certificate) store.getCertificate(ALIAS);
        ApkSigner.SignerConfig signer = new ApkSigner.SignerConfig.Builder("debug", key, List.of(certificate)).build();
        new ApkSigner.Builder(List.of(signer))
            .setInputApk(unsigned.toFile())
            .setOutputApk(signed.toFile())
            .setMinSdkVersion(minimumApi)
            .setV1SigningEnabled(false) // for Android 6 and older
            .setV2SigningEnabled(true)
            .setV3SigningEnabled(true)
            .setAlignFileSize(true)
            .build()
            .sign();
    }

    private static void makeKey(Path keyStore) throws Exception {
        List<String> command = List.of(
            Path.of(System.getProperty("java.home"), "bin", "keytool").toString(), "-genkeypair",
            "-keystore", keyStore.toString(), "-storetype", "PKCS12", "-storepass", PASSWORD, "-alias", ALIAS,
            "-keyalg", "RSA", "-keysize", "2048", "-validity", "10000", "-dname", "CN=Android Debug");
        Process keytool = new ProcessBuilder(command).redirectErrorStream(true).start();
        String said = new String(keytool.getInputStream().readAllBytes());
        if (keytool.waitFor() != 0) throw new IOException("keytool: " + said);
    }

    private static void verify(Path apk, int minimumApi) throws Exception {
        ApkVerifier.Result result =
            new ApkVerifier.Builder(apk.toFile()).setMinCheckedPlatformVersion(minimumApi).build().verify();
        boolean good = result.isVerified() && result.isVerifiedUsingV2Scheme() && result.isVerifiedUsingV3Scheme();
        if (!good) throw new IOException("the APK does not verify: " + result.getAllErrors());
    }

    /** All that the jars hold for the run time has reached the APK. */
    private static void compare(Path apk, Map<String, byte[]> javaResources) throws IOException {
        try (ZipFile zip = new ZipFile(apk.toFile())) {
            for (Map.Entry<String, byte[]> file : javaResources.entrySet()) {
                ZipEntry entry = zip.getEntry(file.getKey());
                boolean same = entry != null && Arrays.equals(bytes(zip, entry), file.getValue());
                if (!same) throw new IOException(file.getKey() + " has not reached the APK");
            }
        }
    }
}

/**
 * The classes that the app's own lead to, class by class: all of the first entry of the class path, what the service lists
 * name, and from there what a class file names, be it as a class, in a signature or in a text, for a text may be looked up by
 * its name at run time. Nothing is taken out of a class.
 */
final class Reachable {
    private static final Pattern IN_SIGNATURE = Pattern.compile("L([\\w/$]+)[;<]");

    /** The real USB library is in Gradle's build only: the app looks whether it is there before it calls it. */
    private static final String USB = "com/hoho/android/usbserial/";
    private final Map<String, byte[]> all = new TreeMap<>();
    private final Map<String, byte[]> kept = new TreeMap<>();
    private final Map<String, String> missing = new TreeMap<>();
    private final Path androidJar;

    Reachable(List<Path> program, Path androidJar, Map<String, byte[]> javaResources) throws IOException {
        this.androidJar = androidJar;
        List<String> next = new ArrayList<>();
        for (Path entry : program) {
            Map<String, byte[]> found = classes(entry);
            if (all.isEmpty()) next.addAll(found.keySet());
            found.forEach(all::putIfAbsent);
        }
        for (Map.Entry<String, byte[]> file : javaResources.entrySet()) {
            if (!file.getKey().startsWith(PackageApk.SERVICES)) continue;
            for (String line : new String(file.getValue()).split("\\R")) next.add(line.replaceAll("#.*", "").trim().replace('.', '/'));
        }
        while (!next.isEmpty()) {
            String name = next.remove(next.size() - 1);
            byte[] bytes = all.get(name);
            if (bytes != null && kept.putIfAbsent(name, bytes) == null) follow(name, bytes, next);
        }
    }

    /** Writes them below [folder]; fails where one of them names a class that neither the program nor Android has. */
    void copyTo(Path folder) throws IOException {
        try (ZipFile android = new ZipFile(androidJar.toFile())) {
            missing.keySet().removeIf(name -> name.startsWith(USB) || android.getEntry(name + ".class") != null || isJavas(name));
        }
        if (!missing.isEmpty()) throw new IOException("classes that are nowhere, and who names them: " + missing);
        for (Map.Entry<String, byte[]> file : kept.entrySet()) {
            Path path = folder.resolve(file.getKey() + ".class");
            Files.createDirectories(path.getParent());
            Files.write(path, file.getValue());
        }
        System.out.println(kept.size() + " of " + all.size() + " classes are reached");
    }

    private static boolean isJavas(String name) {
        return ClassLoader.getPlatformClassLoader().getResource(name + ".class") != null;
    }

    private static Map<String, byte[]> classes(Path entry) throws IOException {
        Map<String, byte[]> found = new TreeMap<>();
        if (Files.isDirectory(entry)) {
            try (Stream<Path> files = Files.walk(entry)) {
                for (Path file : files.filter(path -> path.toString().endsWith(".class")).toList()) {
                    put(found, entry.relativize(file).toString().replace(File.separatorChar, '/'), Files.readAllBytes(file));
                }
            }
        } else {
            try (ZipFile jar = new ZipFile(entry.toFile())) {
                for (ZipEntry file : (Iterable<ZipEntry>) jar.stream().map(ZipEntry.class::cast)::iterator) {
                    put(found, file.getName(), PackageApk.bytes(jar, file));
                }
            }
        }
        return found;
    }

    private static void put(Map<String, byte[]> found, String name, byte[] bytes) {
        boolean isClass = name.endsWith(".class") && !name.startsWith("META-INF/") && !name.endsWith("module-info.class");
        if (isClass) found.put(name.substring(0, name.length() - ".class".length()), bytes);
    }

    /** Source: The Java Virtual Machine Specification 17, section 4.4, the constant pool. */
    private void follow(String name, byte[] bytes, List<String> next) throws IOException {
        DataInputStream in = new DataInputStream(new ByteArrayInputStream(bytes));
        in.skipNBytes(8);
        int count = in.readUnsignedShort();
        String[] texts = new String[count];
        List<Integer> named = new ArrayList<>();
        for (int index = 1; index < count; index++) {
            int tag = in.readUnsignedByte();
            switch (tag) {
                case 1 -> texts[index] = in.readUTF();
                case 7 -> named.add(in.readUnsignedShort());
                case 8, 16, 19, 20 -> in.skipNBytes(2);
                case 15 -> in.skipNBytes(3);
                case 3, 4, 9, 10, 11, 12, 17, 18 -> in.skipNBytes(4);
                case 5, 6 -> {
                    in.skipNBytes(8);
                    index++;
                }
                default -> throw new IOException(name + ": a constant of kind " + tag);
            }
        }
        for (int index : named) {
            String type = texts[index].startsWith("[") ? texts[index].replaceAll("^\\[+L?|;$", "") : texts[index];
            boolean isPrimitive = texts[index].startsWith("[") && !texts[index].endsWith(";");
            if (!isPrimitive && !all.containsKey(type)) missing.putIfAbsent(type, name);
        }
        for (String text : texts) {
            if (text == null) continue;
            next.add(text.replace('.', '/'));
            Matcher matcher = IN_SIGNATURE.matcher(text);
            while (matcher.find()) next.add(matcher.group(1));
        }
    }
}
