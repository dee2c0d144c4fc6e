package android.bluetooth;

/**
 * Robolectric 4.17's shadow of BluetoothDevice names this class in a signature; only the newest Androids have it, and
 * without it the shadow loads on none of the older ones. For tests only.
 */
final class BluetoothDevice$BluetoothAddress {}
